"""What the scripts that make tables of docs share."""
import subprocess


def run(*command):
    """Runs a tool and returns its last line of output. Ends the script where it fails; code 5, some faces without
    triangles, is no failure."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode not in (0, 5):
        raise SystemExit(f"{command[0]}: {done.stderr}")
    return done.stdout.splitlines()[-1] if done.stdout else ""
