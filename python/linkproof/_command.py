"""The command `linkproof`, run in this process."""

import signal
import sys
from typing import NoReturn


def main() -> NoReturn:
    """Run the command with the arguments of the process, and end the process with its exit code."""
    # With Python's handler, Ctrl-C would act only after the command has ended.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    from linkproof._linkproof import run_command

    sys.exit(run_command(["linkproof", *sys.argv[1:]]))
