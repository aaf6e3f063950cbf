# The first interpreter that runs and is new enough; or make PYTHON=/path/to/python3.11
ifndef PYTHON
PYTHON := $(firstword $(foreach python,python3.11 python3 python3.12 python3.13 python3.14,\
  $(shell $(python) -c 'import sys; sys.version_info >= (3, 11) and print("$(python)")' 2>/dev/null)))
endif

BIN := .venv/bin
QUIETLY := --quiet --no-compile --disable-pip-version-check -c constraints.txt
# By a new pip: one that comes with Python looks twice as long for what to install.
INSTALL := $(BIN)/python -m pip install $(QUIETLY)
# On all cores, what pip does on one: half of the time it takes. Some packages hold files that are
# no Python to this version; pip is silent about them too. The tests of the packages, a third of
# all of it, nobody imports; of the tools' packages little is, and Python compiles that as it goes.
SELDOM := tests?|testsuite|cuda|dask|distributed|distutils|ezdxf|fontTools|fsspec|hatchling|lexers
SELDOM := $(SELDOM)|pip|pymeasure|pyqtgraph|pyvista|tomlkit|trimesh|vtkmodules
BYTES := $(BIN)/python -W ignore -m compileall -qq -j 0 -x '/($(SELDOM))/' .venv/lib || true
PYTEST_OPTIONS ?= -n auto --dist loadfile --no-loadscope-reorder --durations 25 --durations-min 5
# Of the campaigns among the slow tests, each one statement on thousands of inputs, this share.
SHARE ?= 1
# Of the others, this part: 0/6 to 5/6 are all of them together.
PART ?= 0/1
# Compiled modules are kept: the tests start hundreds of processes.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: help run test slow lint types page-types floors docs examples bench vendor clean

run: .venv/.runtime  ## reproduce the thesis: claims, figures and tables into out/thesis/index.html
	$(BIN)/asperity thesis

# One worker more than cores, since many of these wait for processes, servers and browsers.
test slow: export PYTEST_XDIST_AUTO_NUM_WORKERS = $(shell $(PYTHON) -c 'import os; print(os.cpu_count() + 1)')

slow: WHICH = --slow

test: .venv/.test  ## prove what the package states, in a few minutes
	$(BIN)/python -m pytest $(PYTEST_OPTIONS)

slow: .venv/.slow  ## prove the rest of it
	$(BIN)/python -m pytest -m slow --share $(SHARE) --part $(PART) $(PYTEST_OPTIONS)

lint: .venv/.dev  ## look at format, style and docstrings
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/python docs/docstrings.py
	$(BIN)/python -m pytest -q tests/unit/test_public_docstrings.py

types: .venv/.dev  ## check the types
	$(BIN)/mypy

page-types: .venv/bin/python  ## check the types of the page's modules; needs npm
	$(BIN)/python vendored/check_types.py

floors: .venv/.dev  ## check that rooms import only from below, and in no circles
	$(BIN)/lint-imports

docs: .venv/.dev  ## build the documentation into docs/_build/html
	$(BIN)/sphinx-build -W --keep-going -q docs docs/_build/html

examples: .venv/.dev  ## run the examples
	@for file in $(wildcard examples/*.py); do \
	  echo "$$file"; MPLBACKEND=Agg $(BIN)/python "$$file" || exit 1; \
	done

bench: .venv/.dev  ## measure speed, as ratios
	@for file in $(wildcard benchmarks/[a-z]*.py); do \
	  echo "$$file"; $(BIN)/python "$$file" || exit 1; \
	done

vendor: .venv/bin/python  ## make the page's vendored files anew, of the versions in vendored/; needs npm
	$(BIN)/python vendored/make.py

help:  ## say what can be made
	@sed -n 's/^\([a-z-]*\):.*  ## \(.*\)/\1\t\2/p' $(MAKEFILE_LIST) | expand -t 12

clean:  ## remove everything that was made
	rm -rf .venv out dist build docs/_build docs/api docs/gallery docs/sg_execution_times.rst
	rm -rf .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache

.venv/bin/python:
	@test -n "$(PYTHON)" && $(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "asperity needs Python 3.11 or later; name one: make PYTHON=/path/to/python3.11"; exit 1; }
	$(PYTHON) -m venv --without-pip .venv
	@$(PYTHON) -m pip --python $@ install $(QUIETLY) pip 2>/dev/null || \
	  { $@ -m ensurepip >/dev/null && { $@ -m pip install $(QUIETLY) pip 2>/dev/null || true; }; } || \
	  { rm $@; exit 1; }

.venv/.runtime: pyproject.toml constraints.txt | .venv/bin/python
	@$(BIN)/python -m pip --version >/dev/null 2>&1 || \
	  { rm -rf .venv/lib/python3*/site-packages/pip .venv/lib/python3*/site-packages/pip-*; \
	    $(BIN)/python -m ensurepip >/dev/null; }
	$(INSTALL) -e .
	@$(BYTES)
	@touch $@

# Kernels are compiled on the core that pip leaves free. The package itself is there already, and not
# built anew: of its own metadata are the packages that come to it.
.venv/.test: .venv/.runtime
	$(BIN)/python tests/warm.py $(WHICH) & \
	  $(INSTALL) 'asperity[test]' && { $(BYTES); $(BIN)/python tests/bytecode.py; wait; }
	@touch $@

.venv/.slow: .venv/.test
	$(INSTALL) 'asperity[slow]'
	@touch $@

.venv/.dev: .venv/.runtime
	$(INSTALL) 'asperity[dev]'
	@touch $@
