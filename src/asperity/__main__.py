"""`python -m asperity` is the command line."""

from asperity.cli.main import program

if __name__ == "__main__":
    program()
