"""python -m st wing.step [options of st-run]: a checked mesh."""
import os
import sys

from .tools import program


def main():
    path = program("st-run")
    os.execv(path, [path, *sys.argv[1:]])


if __name__ == "__main__":
    main()
