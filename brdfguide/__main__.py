"""`brdfguide` and `python -m brdfguide`."""

import sys


def main() -> None:
    """Run the command line: in a few milliseconds where that is possible, else with the full parser."""
    from .quick import answered

    try:
        if answered(sys.argv[1:]):
            return
    except KeyboardInterrupt:
        sys.exit(130)
    except BrokenPipeError:  # who read us has enough
        import os

        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return
    from .cli import main

    main()


if __name__ == "__main__":
    main()
