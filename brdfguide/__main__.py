"""`brdfguide` and `python -m brdfguide`."""

import sys


def main() -> None:
    """Run the command line: in a few milliseconds where that is possible, else with the full parser."""
    from .quick import answered

    try:
        if answered(sys.argv[1:]):
            return
    except (KeyboardInterrupt, BrokenPipeError):
        pass  # the full parser meets the same and says it in its own way
    from .cli import main

    main()


if __name__ == "__main__":
    main()
