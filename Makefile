# Needs make, a C compiler and Python 3.11 or later; everything else goes into .venv.

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready
CODE := pyimu tests benchmarks examples fuzz docs/build
PART ?= imt30
OUT ?= out
# What a file builds, it builds once. In their order, as files of few tests that take long would come last.
SPREAD := -n auto --dist loadfile --no-loadscope-reorder

.PHONY: help demo test test-long lint generate docs fmus bench fuzz

help:
	@echo "make demo      the whole loop on a simulated recording; report under $(OUT)/demo"
	@echo "make test      the tests, on all cores"
	@echo "make test-long those that take minutes: cases of the benchmarks, long statistics"
	@echo "make lint      style, format and types"
	@echo "make generate  what is written from the definitions: docs, pictures, fmu_src/generated, modelica"
	@echo "make docs      the documentation as a site under $(OUT)/site/site"
	@echo "make fmus      the FMUs of PART ($(PART)) under $(OUT)/fmus"
	@echo "make bench     speed against named peers"
	@echo "make fuzz      random calls and damaged files, for a long time"

# The stamp is older than pyproject.toml exactly when what must be installed may have changed.
$(READY): pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or later is needed: make PYTHON=python3.12")'
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --editable '.[test,lint]'
	touch $@

demo: $(READY)
	$(BIN)/pyimu demo

test: $(READY)
	$(BIN)/python -m pytest $(SPREAD)

test-long: $(READY)
	$(BIN)/python -m pytest $(SPREAD) -m long

lint: $(READY)
	$(BIN)/python -m ruff check $(CODE)
	$(BIN)/python -m ruff format --check $(CODE)
	$(BIN)/python -m mypy

generate: $(READY)
	$(BIN)/python docs/build/effects_page.py
	$(BIN)/python docs/build/noise_page.py
	$(BIN)/python docs/build/api_page.py
	$(BIN)/python docs/build/attitude_page.py
	$(BIN)/python -m pyimu.fmu.generate
	$(BIN)/python -m pyimu.modelica.generate
	@echo "Files that changed are named above."

docs: $(READY)
	$(BIN)/python docs/build/docs_site.py $(OUT)/site

fmus: $(READY)
	$(BIN)/pyimu build $(PART) --out $(OUT)/fmus

bench: $(READY)
	$(BIN)/python -m pip install --quiet --editable '.[bench]'
	for b in benchmarks/*.py; do $(BIN)/python "$$b" || exit 1; done

fuzz: $(READY)
	for f in fuzz/*.py; do $(BIN)/python "$$f" || exit 1; done
