"""A real browser before a real server: one of each for all tests of a worker."""

import os
import shutil
from pathlib import Path

import pytest
from apparatus.page import Served

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


def pytest_ignore_collect(config):
    # Where no slow tests are asked for, nobody imports playwright either.
    return True if config.option.markexpr == "not slow" else None


def pytest_collection_modifyitems(items):
    here = Path(__file__).parent
    for item in items:
        if item.path.is_relative_to(here):
            item.add_marker(pytest.mark.slow)


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """The page's server on a folder of its own."""
    served = Served(tmp_path_factory.mktemp("page"), dict(os.environ), "--port", "0")
    yield served
    served.close()


@pytest.fixture(scope="session")
def browser():
    """Debian's chromium; without it the tests are left out."""
    if CHROMIUM is None:
        pytest.skip("chromium is not installed: apt-get install chromium")
    from apparatus.browser import LONG
    from playwright.sync_api import expect, sync_playwright

    expect.set_options(timeout=LONG)
    with sync_playwright() as playwright:
        # What is drawn in two dimensions needs no graphics card, and there may be none.
        arguments = ["--disable-gpu", "--no-sandbox"]
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=arguments)
        yield browser
        browser.close()


@pytest.fixture
def seen(seen_as):
    """A page that is seen; ``seen.open(SCREEN, case=...)`` returns playwright's."""
    return seen_as()


@pytest.fixture
def seen_as(browser, server):
    """The same, with options of its context such as ``color_scheme`` or ``viewport``."""
    from apparatus.browser import Seen

    opened = []

    def make(**context):
        opened.append(Seen(browser, server, **context))
        return opened[-1]

    yield make
    for each in opened:
        each.close()
