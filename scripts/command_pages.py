#!/usr/bin/env python3
"""Man pages and completions of bash, zsh and fish from what the tools' own --help-all says.

usage: command_pages.py BIN_DIR OUT_DIR [PAGE...]      writes OUT_DIR/{man1/*.1.gz, bash/*, zsh/_*, fish/*.fish}
       PAGE: a man page that is there already
"""
import gzip
import re
import subprocess
import sys
from pathlib import Path

OPTION = re.compile(
    r"^  (?P<names>-[\w-]+(?:,-[\w-]+)*)(?P<value> (?!Excludes:|Needs:|REQUIRED)[A-Z][^ ]*)?(?P<rest>.*)$")


class Tool:
    """A tool's help: description, positional arguments, options, notes below them."""

    def __init__(self, program):
        self.name = program.name
        text = self.ask(program, "--help-all")
        self.version = self.ask(program, "--version").split()[-1]
        head, _, rest = text.partition("\nUsage: ")
        self.description = " ".join(head.split())
        self.usage, _, rest = rest.partition("\n")
        self.positionals, self.options, self.notes, self.examples = [], [], [], []
        section = self.notes
        for line in rest.splitlines():
            if line == "Positionals:":
                section = self.positionals
            elif line == "Options:" or line.startswith("Options of "):
                section = self.options
            elif line == "Examples:":
                section = self.examples
            elif line.startswith("      ") and section and section is not self.notes:
                section[-1] = (section[-1][0], (section[-1][1] + " " + line.strip()).strip())
            elif line.startswith("  "):
                head, _, help_text = line.strip().partition("  ")
                section.append((head, help_text.strip()))
            elif line:
                section = self.notes
                self.notes.append((line, ""))

    @staticmethod
    def ask(program, argument):
        return subprocess.run([program, argument], capture_output=True, text=True, check=True).stdout

    def flags(self):
        """(names, whether a value follows, help) of each option."""
        for head, help_text in self.options:
            match = OPTION.match("  " + head)
            yield match["names"].split(","), bool(match["value"]), help_text


def roff(text):
    """Text that troff takes as it is."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def man_page(tool):
    lines = [f'.TH {tool.name.upper()} 1 "" "ST {tool.version}" "User Commands"', ".SH NAME",
             roff(tool.name) + " \\- " + roff(tool.description.split(". ")[0].rstrip(".")), ".SH SYNOPSIS",
             f".B {roff(tool.usage)}", ".SH DESCRIPTION", roff(tool.description)]
    for title, entries in (("ARGUMENTS", tool.positionals), ("OPTIONS", tool.options)):
        if entries:
            lines.append(f".SH {title}")
        for head, help_text in entries:
            lines += [".TP", f".B {roff(head)}", roff(help_text)]
    if tool.examples:
        lines += [".SH EXAMPLES", ".nf", *(roff(" ".join(entry).rstrip()) for entry in tool.examples), ".fi"]
    if tool.notes:
        lines.append(".SH NOTES")
        for line, _ in tool.notes:
            lines += [roff(line), ".PP"]
        lines.pop()
    lines += [".SH SEE ALSO", "The pages in /usr/share/doc/st/docs."]
    return "\n".join(lines) + "\n"


def bash_completion(tool):
    flags = [f for names, _, _ in tool.flags() for f in names]
    values = [f for names, has_value, _ in tool.flags() if has_value for f in names]
    function = "_" + tool.name.replace("-", "_")
    return f"""# {tool.name}: options, then files
{function}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD-1]}}
  case $last in {"|".join(values) or "''"}) mapfile -t COMPREPLY < <(compgen -f -- "$word"); return ;; esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "{" ".join(flags)}" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F {function} {tool.name}
"""


def quoted(text):
    return text.replace("'", "'\\''")


def zsh_completion(tool):
    rows = [f"#compdef {tool.name}", "_arguments -s \\"]
    for names, has_value, help_text in tool.flags():
        what = re.sub(r"[\[\]:\\]", " ", quoted(help_text))
        for name in names:
            rows.append(f"  '{name}[{what}]{':value:_files' if has_value else ''}' \\")
    return "\n".join(rows) + "\n  '*:file:_files'\n"


def fish_completion(tool):
    rows = []
    for names, has_value, help_text in tool.flags():
        what = help_text.replace("\\", "\\\\").replace("'", "\\'")
        kinds = " ".join(f"-l {n[2:]}" if n.startswith("--") else f"-s {n[1:]}" for n in names)
        rows.append(f"complete -c {tool.name} {kinds}{' -r' if has_value else ''} -d '{what}'")
    return "\n".join(rows) + "\n"


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def write_page(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(gzip.compress(text.encode(), compresslevel=9, mtime=0))


def main(bin_folder, out, pages):
    programs = sorted(p for p in Path(bin_folder).glob("st-*") if p.is_file())
    if not programs:
        sys.exit(f"command_pages: error: no tools in {bin_folder}; build them first")
    for program in programs:
        tool = Tool(program)
        write_page(out / "man1" / f"{tool.name}.1.gz", man_page(tool))
        write(out / "bash" / tool.name, bash_completion(tool))
        write(out / "zsh" / f"_{tool.name}", zsh_completion(tool))
        write(out / "fish" / f"{tool.name}.fish", fish_completion(tool))
    for page in pages:
        write_page(out / "man1" / f"{page.name}.gz", page.read_text(encoding="utf-8"))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], Path(sys.argv[2]), [Path(p) for p in sys.argv[3:]])
