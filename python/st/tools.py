"""The tools as functions: options are keywords, results are dictionaries."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import weakref
from pathlib import Path

from .artifact import Mesh

_WHEEL = Path(__file__).parent / "bin"  # where a wheel has the tools


class ToolError(RuntimeError):
    """A tool that failed: `code` (docs/exit_codes.md) and its own message."""

    def __init__(self, tool, code, message):
        super().__init__(f"{tool} (exit code {code}): {message}")
        self.tool, self.code, self.message = tool, code, message


def program(tool):
    """Its file: in the folder ST_BIN, else in the wheel that this module came with, else in PATH."""
    folder = os.environ.get("ST_BIN")
    if not folder and _WHEEL.is_dir():
        return _in_wheel(tool)
    found = shutil.which(str(Path(folder) / tool) if folder else tool)
    if not found:
        raise FileNotFoundError(f"{tool} is not in {folder or 'PATH'}; install ST")
    return found


def _in_wheel(tool):
    """The file there: of its own, or the one that does what the name says under which it is started."""
    return str(_WHEEL / (tool if (_WHEEL / tool).is_file() else "st-run"))


def command():
    """The tool of the name under which this was started: a command that a wheel installs."""
    tool = Path(sys.argv[0]).name
    os.execv(_in_wheel(tool), [tool, *sys.argv[1:]])


def _arguments(options):
    """lmax=2 gives --lmax 2, max_aspect=8 --max-aspect 8, quads=True --quads, lists an option for each value."""
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        for v in value if isinstance(value, (list, tuple)) else [value]:
            if v is True:
                yield flag
            elif v is not None and v is not False:
                yield from (flag, str(v))


def _start(file, command, progress):
    """Exit code, stdout and stderr of a command, each line of stderr given to `progress` as soon as it is there."""
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as out:
        with subprocess.Popen(command, executable=file, stdout=out, stderr=subprocess.PIPE, text=True,
                              errors="replace") as child:
            said = []
            try:
                for line in child.stderr:
                    said.append(line.rstrip("\n"))
                    if progress:
                        progress(said[-1])
            except BaseException:  # of the callback, too: nothing goes on behind it
                child.terminate()
                raise
        out.seek(0)
        return child.returncode, out.read(), "\n".join(said)


def run(tool, *inputs, allow=(), progress=None, **options):
    """Runs a tool and returns what it says with --json. `allow`: exit codes that are no errors, such as 5 of st-check
    (the dictionary then has it as "exit_code"). `progress`: called with each line that the tool prints while it works;
    what it raises ends the tool. Raises ToolError."""
    command = [tool, *map(str, inputs), *_arguments(options), "--json"]
    code, printed, said = _start(program(tool), command, progress)
    lines = printed.strip().splitlines()
    try:
        result = json.loads(lines[-1]) if lines else {}
    except ValueError:
        result = {}
    if code not in (0, *allow):
        errors = [line for line in said.splitlines() if "error:" in line] or said.splitlines()[-1:]
        raise ToolError(tool, code, " ".join(errors) or "no message")
    result["exit_code"] = code
    return result


def _toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(str(value))


def _option_file(tables):
    """A table for each tool: {"st-raster": {"lmax": "2%"}}."""
    lines = []
    for tool, options in tables.items():
        lines.append(f"[{tool}]")
        lines += [f"{name.replace('_', '-')} = {_toml(value)}" for name, value in options.items() if value is not None]
    return "\n".join(lines) + "\n"


def _run_all(model, ranks, options):
    """What each tool said, by tool."""
    stages = {name: value for name, value in options.items() if name.startswith("st-")}
    own = {name: value for name, value in options.items() if name not in stages}
    if stages and own.get("options"):
        raise TypeError(f"mesh(): options={str(own['options'])!r} and tables by tool ({', '.join(stages)}) exclude "
                        "each other; write the tables into the file")
    if ranks > 1:
        own.setdefault("np", ranks)
    with tempfile.NamedTemporaryFile("w", suffix=".toml", encoding="utf-8") as file:
        file.write(_option_file(stages))
        file.flush()
        own["options"] = own.get("options") or file.name
        said = run("st-run", model, allow=(5,), **own)
    if not said.get("stages"):
        raise ToolError("st-run", 5, said.get("error", "incomplete"))
    return said["stages"]


def mesh(model, out=None, ranks=1, progress=None, **options):
    """From a CAD file to a checked mesh, by st-run. `options`: those of st-run, and those of a stage by its tool's
    name, as in mesh("wing.step", preset="rans", **{"st-raster": {"lmax": "2%"}}); the latter not with options=FILE,
    which raises TypeError. `progress`: see run().

    With a folder `out`: all artifacts go there, and what each tool said is returned, by tool. Without it: the Mesh,
    whose points, triangles, groups and sizes are numpy arrays; its `said` is that dictionary. Its file goes with it. A
    mesh that does not pass its checks is no error: said["st-check"]["passes"] tells."""
    if out is not None:
        return _run_all(model, ranks, {"keep": out, "progress": progress, **options})
    folder = tempfile.mkdtemp(prefix="st-mesh-")
    try:
        said = _run_all(model, ranks, {"output": Path(folder) / "mesh.hdf", "progress": progress, **options})
        result = Mesh(said["st-merge"]["output"])
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    result.said = said
    weakref.finalize(result, shutil.rmtree, folder, ignore_errors=True)
    return result
