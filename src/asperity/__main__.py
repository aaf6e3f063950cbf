"""`python -m asperity` is the command line."""

from asperity.cli.main import main

if __name__ == "__main__":
    main()
