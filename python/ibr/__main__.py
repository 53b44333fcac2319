"""The command line: `python -m ibr demo` is `ibr demo`."""

import sys

from ibr import _ibr


def main() -> None:
    sys.exit(_ibr.program(["ibr", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
