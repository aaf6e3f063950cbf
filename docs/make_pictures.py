"""Draw the picture of the README anew: ``python docs/make_pictures.py``."""

from pathlib import Path

from asperity.store import write_atomically
from asperity.thesis.contents import FIGURES

PICTURES = Path(__file__).parent / "_static"

if __name__ == "__main__":
    figure = FIGURES["4.23"].make().figure
    write_atomically(PICTURES / "directions.png", lambda path: figure.savefig(path, dpi=150))
