"""``python -m hqmodel`` is the command line."""

from hqmodel.cli import main

if __name__ == "__main__":
    main()
