"""`brdfguide` and `python -m brdfguide`."""

from .cli import main

if __name__ == "__main__":
    main()
