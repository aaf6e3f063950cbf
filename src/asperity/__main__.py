"""`python -m asperity` is the command line."""

from asperity.cli.main import main

main()
