# `make help` lists the targets. Only git, make and Python 3.11 to 3.14 are needed beforehand;
# uv is used when it is there, pip otherwise. The environment lives in .venv and is touched
# again only when constraints.txt or pyproject.toml change.

VENV := .venv
BIN := $(VENV)/bin
RUN := $(VENV)/.ready-to-run
SHOW := $(VENV)/.ready-to-show
TEST := $(VENV)/.ready-to-test
LINTED := src tests hatch_build.py packaging web $(wildcard benchmarks verification) docs/conf.py docs/site
UV := $(shell command -v uv 2>/dev/null)
VENDOR := src/equipoise/app/dashboard/static/vendor
VENDORED := $(VENDOR)/uPlot.min.css
KERNELS := src/equipoise/maths/kernels/ready

# The Pythons that every pin has a wheel for; the first that answers is taken.
PYTHONS := python3 python3.14 python3.13 python3.12 python3.11 python
SUPPORTED := import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))

.DEFAULT_GOAL := help
.PHONY: help demo test bench scale verify mutants lint format rooms docs wheel newcomer pins clean
.DELETE_ON_ERROR:

help:  ## list the targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-8s %s\n", $$1, $$2 }' Makefile

demo: $(SHOW) $(VENDORED)  ## identify and balance a simulated microsatellite mock-up
	@$(BIN)/equipoise demo
	@echo
	@echo 'Open the report:      equipoise-out/demo/report.html (on paper: report.pdf)'
	@echo 'Start the dashboard:  $(BIN)/equipoise dashboard'

# A worker more than cores, since some tests wait for a page or a bench in real time.
# Tests start many programs: each would compile all modules again if nobody kept the bytecode.
test bench scale verify mutants: export PYTHONPYCACHEPREFIX := $(abspath $(VENV))/bytecode
test bench scale verify mutants: export PYTHONDONTWRITEBYTECODE :=

test: $(TEST) $(VENDORED)  ## run every test, and the examples of README and docs, on two cores
	@$(BIN)/python -m tests.support.warm_cache
	@$(BIN)/pytest -q -n 3 --dist worksteal

bench: $(TEST)  ## time the fit, the tracker and the simulator beside other tools
	@$(BIN)/python -m benchmarks

scale: $(TEST)  ## what many runs cost by each engine; a run that is killed and resumed
	@$(BIN)/python -m benchmarks.scale

verify: $(TEST) $(VENDORED)  ## the long Monte Carlo and MuJoCo checks, and the long tests whole
	@EQUIPOISE_THOROUGH=1 $(BIN)/pytest -q -n 3 --dist worksteal -m thorough
	@$(BIN)/python -m verification

mutants: $(TEST)  ## break signs, factors and guards one by one: tests have to fail
	@$(BIN)/python -m tests.support.warm_cache
	@$(BIN)/python -m verification.mutants

lint: $(TEST)  ## style, formatting, types, import contracts
	@$(BIN)/ruff check --quiet $(LINTED)
	@$(BIN)/ruff format --quiet --check $(LINTED)
	@$(BIN)/pyright --warnings
	@$(BIN)/lint-imports --no-logo --cache-dir $(VENV)/import_linter

format: $(TEST)  ## put the code in the house format
	@$(BIN)/ruff check --quiet --fix $(LINTED)
	@$(BIN)/ruff format --quiet $(LINTED)

rooms: $(TEST)  ## draw the picture of the rooms in docs/architecture.md
	@$(BIN)/python -m tests.support.rooms

docs: $(TEST)  ## build the documentation in build/site, its gallery and notebooks included
	@$(BIN)/python -m docs.site build/site -D nb_execution_mode=auto
	@echo 'Open build/site/index.html.'

# Kernels for this Python on every x86-64 processor since 2015 or so; others compile their own.
wheel: $(TEST) $(VENDORED)  ## build a wheel in dist, with kernels compiled ahead
	@rm -rf build/kernels $(KERNELS)
	@NUMBA_CPU_NAME=x86-64-v3 NUMBA_CPU_FEATURES= NUMBA_CACHE_DIR=$(abspath build/kernels) $(BIN)/equipoise precompile
	@cp -r build/kernels/equipoise-kernels $(KERNELS)
	@$(BIN)/python -m hatchling build --target wheel

newcomer: wheel  ## follow a newcomer's path with the wheel in a fresh environment, and time it
	@$(BIN)/python -m tests.docs.newcomer dist/*.whl

clean:  ## remove the environment, caches and outputs
	rm -rf $(VENV) .pytest_cache .ruff_cache .hypothesis .benchmarks
	rm -rf dist build equipoise-out web/node_modules $(VENDOR) $(KERNELS)
	find src tests -name __pycache__ -prune -exec rm -rf {} +

# --- The environment -------------------------------------------------------------------------
# constraints.txt has three parts: what running needs, what PDF and dashboard (the demo's extras)
# need beside it, and what only testing needs. The closure is complete, so nothing is resolved here:
# each line is fetched and checked against its hashes.

ifneq ($(UV),)
INSTALL := $(UV) pip install --quiet --python $(BIN)/python
HAS_INSTALLER := $(UV) --version
else
INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-input
HAS_INSTALLER := $(BIN)/python -m pip --version
endif

define make_venv
	$(BIN)/python -c '$(SUPPORTED)' 2>/dev/null && $(HAS_INSTALLER) >/dev/null 2>&1 && exit 0; \
	found=; able=; \
	for python in $(PYTHONS); do \
		$$python -c '$(SUPPORTED)' 2>/dev/null || continue; \
		found=$${found:-$$python}; \
		$$python -c 'import venv, ensurepip' 2>/dev/null && able=$$python && break; \
	done; \
	if test -n "$(UV)"; then \
		"$(UV)" venv --quiet --clear --python "$${found:->=3.11,<3.15}" $(VENV); \
	elif test -n "$$able"; then \
		$$able -m venv --clear $(VENV); \
	elif test -n "$$found"; then \
		echo "$$found has no venv module: install python3-venv (Debian, Ubuntu) or uv" >&2; \
		exit 1; \
	else \
		echo 'Python 3.11 to 3.14 is needed and none was found: install python3 or uv' >&2; \
		exit 1; \
	fi
endef

$(RUN): constraints.txt pyproject.toml
	@echo 'Making the environment in $(VENV): what running needs ...'
	@$(make_venv)
	@sed '/^# To show/,$$d' constraints.txt > $(VENV)/to-run.txt
	@$(INSTALL) --require-hashes --no-deps -r $(VENV)/to-run.txt
	@$(INSTALL) --no-deps --no-build-isolation --editable .
	@touch $@

$(SHOW): $(RUN)
	@echo 'Adding to $(VENV) what PDF and dashboard need ...'
	@sed '1,/^# To show/d; /^# To test/,$$d' constraints.txt > $(VENV)/to-show.txt
	@$(INSTALL) --require-hashes --no-deps -r $(VENV)/to-show.txt
	@touch $@

$(TEST): $(RUN)
	@echo 'Adding to $(VENV) what testing needs ...'
	@$(INSTALL) --require-hashes --no-deps -r constraints.txt
	@touch $@

# --- What the dashboard's page takes from others ---------------------------------------------
# Two libraries at the versions and hashes of web/package-lock.json, copied beside our modules, so
# that a browser fetches nothing from elsewhere. Where npm or the network is missing, all but the
# dashboard works, and the next make tries again: then no file is left behind.

$(VENDORED): web/package-lock.json web/package.json | $(RUN)
	@$(BIN)/python web/page_libraries.py || true

# --- The pins --------------------------------------------------------------------------------

COMPILE := uv pip compile pyproject.toml --quiet --universal --python-version 3.11 \
	--generate-hashes --no-annotate --no-header --no-emit-index-url --no-emit-find-links
EXTRAS := $(foreach extra,analysis parquet excel matlab hardware mavlink camera logs report dashboard cluster notebook,--extra $(extra))
DEMO_EXTRAS := --extra report --extra dashboard
# Blocks of the second file whose name==version is (wanted=1) or is not (wanted=0) in the first.
PICK := awk 'NR == FNR { first[$$1]; next } \
	!/^ / { keep = (($$1 in first) == wanted) } keep'

pins:  ## resolve all versions anew and write constraints.txt (needs uv)
	@test -n "$(UV)" || { echo 'make pins needs uv: install uv' >&2; exit 1; }
	@set -e; work=$$(mktemp -d); trap 'rm -rf "$$work"' EXIT; \
	$(COMPILE) --upgrade --group build --group dev --group docs $(EXTRAS) -o $$work/all.txt; \
	$(COMPILE) --group build --constraints $$work/all.txt -o $$work/run.txt; \
	$(COMPILE) --group build $(DEMO_EXTRAS) --constraints $$work/all.txt -o $$work/show.txt; \
	$(PICK) wanted=0 $$work/run.txt $$work/all.txt > $$work/more.txt; \
	{ \
		echo '# Written by `make pins`: names, versions and hashes, for every platform.'; \
		echo '# To run'; \
		$(PICK) wanted=1 $$work/run.txt $$work/all.txt; \
		echo '# To show'; \
		$(PICK) wanted=1 $$work/show.txt $$work/more.txt; \
		echo '# To test'; \
		$(PICK) wanted=0 $$work/show.txt $$work/more.txt; \
	} > $$work/constraints.txt; \
	mv $$work/constraints.txt constraints.txt
	@echo "constraints.txt: $$(grep -c == constraints.txt) pins"
