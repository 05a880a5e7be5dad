"""``python -m arthur_acausal`` is ``arthur``."""

from arthur_acausal.cli import main

if __name__ == "__main__":
    main()
