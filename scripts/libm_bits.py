#!/usr/bin/env python3
"""Which functions of the C library give other bits on processors without AVX2 and FMA: the share of arguments.

usage: scripts/libm_bits.py [--arguments 200000]     on a processor that has both; needs glibc
"""
import argparse
import math
import os
import random
import struct
import subprocess
import sys

WITHOUT = "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable"
FUNCTIONS = {
    "sin": lambda x, y: math.sin(20 * x - 10), "cos": lambda x, y: math.cos(20 * x - 10),
    "tan": lambda x, y: math.tan(3 * x - 1.5), "asin": lambda x, y: math.asin(2 * x - 1),
    "acos": lambda x, y: math.acos(2 * x - 1), "atan": lambda x, y: math.atan(20 * x - 10),
    "atan2": lambda x, y: math.atan2(2 * x - 1, 2 * y - 1), "exp": lambda x, y: math.exp(20 * x - 10),
    "log": lambda x, y: math.log(10 * x + 1e-9), "pow": lambda x, y: math.pow(10 * x, 6 * y - 3),
    "sqrt": lambda x, y: math.sqrt(x), "fmod": lambda x, y: math.fmod(100 * x, y + 0.01)}


def values(n):
    for name in FUNCTIONS:
        rng = random.Random(1)
        yield struct.pack(f"{n}d", *(FUNCTIONS[name](rng.random(), rng.random()) for _ in range(n)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arguments", type=int, default=200000)
    parser.add_argument("--print", action="store_true", help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.print:
        for block in values(args.arguments):
            sys.stdout.buffer.write(block)
        return
    command = [sys.executable, __file__, "--print", "--arguments", str(args.arguments)]
    other = subprocess.run(command, env=os.environ | {"GLIBC_TUNABLES": WITHOUT}, stdout=subprocess.PIPE, check=True)
    for k, (name, block) in enumerate(zip(FUNCTIONS, values(args.arguments))):
        theirs = other.stdout[k * len(block):(k + 1) * len(block)]
        differ = sum(block[i:i + 8] != theirs[i:i + 8] for i in range(0, len(block), 8))
        print(f"{name:6} {differ:6} of {args.arguments}  {100 * differ / args.arguments:.4f} %")


if __name__ == "__main__":
    main()
