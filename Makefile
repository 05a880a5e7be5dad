# `make demo` runs the powertrain, `make test` checks everything; both need only Python and make.
.NOTPARALLEL:
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help
.PHONY: help install demo test lint types tests coverage bench clean distclean

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip
CONSTRAINED := --constraint constraints.txt

DEMO_MODEL ?= arthur.demo
DEMO := $(BIN)/arthur simulate $(DEMO_MODEL) -t 1 --rtol 1e-6 -o demo.nc --plot demo.png

export PIP_DISABLE_PIP_VERSION_CHECK := 1
# pyright comes whole from PyPI; without this it asks the npm registry for a newer one.
export PYRIGHT_PYTHON_IGNORE_WARNINGS := 1

help: ## this list
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' Makefile | while IFS="$$(printf '\t')" read -r goal text; do \
	  printf '  make %-10s %s\n' "$$goal" "$$text"; done

install: $(VENV)/.installed ## make .venv and install the package into it

demo: $(VENV)/.installed ## simulate one second of the ARTHuR powertrain: demo.nc and demo.png
	$(DEMO)

test: lint types tests ## all checks: ruff, mypy, pyright, layers, all tests

lint: $(VENV)/.installed-test ## ruff, rules and format
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/.installed-test ## mypy (strict) and pyright
	$(BIN)/mypy
	$(BIN)/pyright --pythonpath $(BIN)/python

tests: $(VENV)/.installed-test ## all tests, the layer check among them
	$(BIN)/python -m pytest --durations=15

coverage: $(VENV)/.installed-test ## all tests, with the lines that none of them ran
	$(BIN)/python -m pytest --cov --cov-report=term-missing

bench: $(VENV)/.installed-test ## the benchmarks, one JSON object each
	$(BIN)/python -m benchmarks.powertrain --json
	$(BIN)/python -m benchmarks.scale --json

clean: ## remove what builds, tests and the demo wrote
	rm -rf build dist *.egg-info .coverage .mypy_cache .pytest_cache .ruff_cache .hypothesis demo.nc demo.png
	find . -path ./$(VENV) -prune -o -type d -name __pycache__ -exec rm -rf {} +

distclean: clean ## the same, and .venv
	rm -rf $(VENV)

$(VENV)/.made:
	@$(PYTHON) -c 'import sys; v = sys.version_info; v >= (3, 11) or sys.exit( \
	  f"Python 3.11 or newer is needed and $(PYTHON) is {v[0]}.{v[1]}: make PYTHON=/path/to/python3.11 ...")'
	$(PYTHON) -m venv $(VENV)
	touch $@

# setuptools first and no build isolation: the build backend too has its version from constraints.txt.
$(VENV)/.installed: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) install --quiet $(CONSTRAINED) setuptools
	$(PIP) install --quiet $(CONSTRAINED) --no-build-isolation --editable .
	touch $@

$(VENV)/.installed-test: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) install --quiet $(CONSTRAINED) setuptools
	$(PIP) install --quiet $(CONSTRAINED) --no-build-isolation --editable '.[test]'
	touch $(VENV)/.installed $@
