"""The tools as functions: options are keywords, results are dictionaries."""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

_WHEEL = Path(__file__).parent / "bin"  # where a wheel has the tools


class ToolError(RuntimeError):
    """A tool that failed: `code` (docs/exit_codes.md) and its own message."""

    def __init__(self, tool, code, message):
        super().__init__(f"{tool} (exit code {code}): {message}")
        self.tool, self.code, self.message = tool, code, message


def _program(tool):
    """In the folder ST_BIN, else in the wheel that this module came with, else in PATH."""
    folder = os.environ.get("ST_BIN") or (str(_WHEEL) if _WHEEL.is_dir() else None)
    found = shutil.which(str(Path(folder) / tool) if folder else tool)
    if not found:
        raise FileNotFoundError(f"{tool} is not in {folder or 'PATH'}; install ST")
    return found


def command():
    """The tool of the name under which this was started: a command that a wheel installs."""
    tool = _program(Path(sys.argv[0]).name)
    os.execv(tool, [tool, *sys.argv[1:]])


def _arguments(options):
    """lmax=2 gives --lmax 2, max_aspect=8 --max-aspect 8, quads=True --quads, lists an option for each value."""
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        for v in value if isinstance(value, (list, tuple)) else [value]:
            if v is True:
                yield flag
            elif v is not None and v is not False:
                yield from (flag, str(v))


def run(tool, *inputs, allow=(), **options):
    """Runs a tool and returns what it says with --json. `allow`: exit codes that are no errors, such as 5 of st-check
    (the dictionary then has it as "exit_code"). Raises ToolError."""
    command = [_program(tool), *map(str, inputs), *_arguments(options), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    lines = done.stdout.strip().splitlines()
    try:
        result = json.loads(lines[-1]) if lines else {}
    except ValueError:
        result = {}
    if done.returncode not in (0, *allow):
        said = [line for line in done.stderr.splitlines() if "error:" in line] or done.stderr.splitlines()[-1:]
        raise ToolError(tool, done.returncode, " ".join(said) or "no message")
    result["exit_code"] = done.returncode
    return result


def mesh(model, out, ranks=1, **options):
    """From a CAD file to out/mesh.hdf, all artifacts beside it. `options`: of each tool by its name, as in
    mesh("wing.step", "out", **{"st-raster": {"lmax": "2%"}}). Returns what each tool said, by tool."""
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    at = {name: folder / f"{name}.hdf" for name in ("geometry", "raster", "sizing", "patches", "mesh")}
    chain = [("st-import", [model], "geometry"), ("st-raster", [at["geometry"]], "raster"),
             ("st-prolong", [at["raster"]], "sizing"), ("st-mesh", [at["geometry"], at["sizing"]], "patches"),
             ("st-merge", [at["patches"]], "mesh")]
    unknown = set(options) - {tool for tool, _, _ in chain}
    if unknown:
        raise TypeError(f"no tool of the chain: {', '.join(sorted(unknown))}")
    said = {}
    for tool, inputs, output in chain:
        given = dict(options.get(tool, {}))
        if ranks > 1 and tool in ("st-raster", "st-mesh"):
            given.setdefault("np", ranks)
        said[tool] = run(tool, *inputs, output=at[output], **given)
    return said
