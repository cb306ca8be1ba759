# make run    sets everything up and opens the modeller (without a display it renders and exports a preset into out/)
# make test   sets everything up and runs every check
# make test-oldest  runs the core's with the oldest dependencies        make test-oldest-sample  runs a minute of them
# make bench  runs the benchmarks        make reliability  the long runs behind docs/reliability.md
# make clean  removes what these made

VENV ?= .venv
BIN := $(VENV)/bin
PYTHONS := python3 python3.14 python3.13 python3.12 python3.11

# OpenGL, off screen too, and what a window on X11 needs; the second list is for the tests' own display.
LIBRARIES := libegl1 libgl1 libgl1-mesa-dri libglx-mesa0 libopengl0 libx11-6 libx11-xcb1 libxcursor1 libxext6 libxi6 \
	libxinerama1 libxrandr2 libxrender1
DISPLAYS := xvfb xauth xdotool

# A Python of at least 3.11 that can make virtual environments (Debian splits that off).
SUITABLE := -c 'import sys, ensurepip; sys.exit(sys.version_info < (3, 11))' 2>/dev/null
NEEDS_PYTHON := $(if $(wildcard $(BIN)/python),,$(shell for p in $(PYTHONS); do $$p $(SUITABLE) && exit; done; echo python3-venv))

.PHONY: run test test-oldest test-oldest-sample demo bench reliability pictures goldens schema clean system-run system-test
.DEFAULT_GOAL := run

run: system-run $(VENV)/.installed
	@status=3; \
	if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ] || [ "$$(uname)" = Darwin ]; then $(BIN)/hqmodel; status=$$?; fi; \
	if [ $$status -ne 3 ]; then exit $$status; fi; \
	echo "There is no display to open a window on: rendering and exporting a built-in preset into out/ instead."; \
	$(MAKE) --no-print-directory demo

demo:
	@mkdir -p out
	@demo=$${DEMO:-apple}; \
	$(BIN)/hqmodel render "$$demo" -o "out/$$demo.png" && \
	$(BIN)/hqmodel export "$$demo" -o "out/$$demo.glb" -o "out/$$demo.obj"

test: system-test $(VENV)/.installed-for-tests
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m pytest -n 2

# The core's tests with the oldest versions that pyproject.toml permits, in an environment of its own.
OLDEST := $(VENV)-oldest
CORE := $(addprefix tests/,field model edit files mesh outline cli gpu reliability/test_resources.py test_memory.py test_package.py)

test-oldest: system-test $(OLDEST)/.installed
	$(OLDEST)/bin/python -m pytest -n 2 $(CORE)

# A minute of them, in which each dependency has its part.
SAMPLE := $(addprefix tests/,model $(addprefix field/test_,faces.py radial.py region.py) $(addprefix files/test_,load.py schema.py settings.py) \
	mesh/test_formats.py outline/test_drawings.py $(addprefix cli/test_,animate.py export.py figures.py main.py) \
	reliability/test_resources.py test_package.py)

test-oldest-sample: system-test $(OLDEST)/.installed
	$(OLDEST)/bin/python -m pytest -n 2 $(SAMPLE)

bench: system-test $(VENV)/.installed-for-benchmarks
	$(BIN)/python -m benchmarks.meshers --cells 256 384 512
	$(BIN)/python -m benchmarks.meshers --large
	$(BIN)/python -m benchmarks.accuracy
	$(BIN)/python -m benchmarks.accuracy --cells 128 --gamma 400
	$(BIN)/python -m tests.mesh.volumes 200 256
	$(BIN)/python -m benchmarks.preview
	LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1600x1000x24" $(BIN)/python -m benchmarks.dragging
	$(BIN)/python -m benchmarks.solvers
	$(BIN)/python -m benchmarks.fitting

reliability: system-test $(VENV)/.installed-for-tests
	$(BIN)/python -m benchmarks.reliability

pictures: system-test $(VENV)/.installed
	LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1400x900x24" $(BIN)/python docs/pictures.py
	LIBGL_ALWAYS_SOFTWARE=1 $(BIN)/python -m docs.lessons

# What the golden tests compare with; look at each picture before committing it.
goldens: system-test $(VENV)/.installed-for-tests
	LIBGL_ALWAYS_SOFTWARE=1 $(BIN)/python -m tests.gpu.goldens

schema: $(VENV)/.installed
	$(BIN)/python -c "from hqmodel.files import schema_text; print(schema_text(), end='')" > presets/hqmodel-1.schema.json

clean:
	rm -rf $(VENV) $(OLDEST) out build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# The environment; the stamps make a second run instant.
$(VENV)/bin/python:
	@for python in $(PYTHONS); do \
		if $$python $(SUITABLE); then \
			echo "Making $(VENV) with $$($$python --version)"; exec $$python -m venv $(VENV); \
		fi; \
	done; \
	echo "Python 3.11 or later, with its venv module, is needed (on Debian and Ubuntu: apt-get install python3-venv)." >&2; exit 1

$(VENV)/.installed: pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e .
	@touch $@

$(VENV)/.installed-for-tests: pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[test]"
	@touch $@ $(VENV)/.installed

# By an old Python too, if there is one: of old packages there is nothing ready-made for later ones.
$(OLDEST)/.installed: pyproject.toml tests/oldest.py
	@for python in python3.11 python3.12 $(PYTHONS); do \
		if $$python $(SUITABLE); then \
			echo "Making $(OLDEST) with $$($$python --version)"; $$python -m venv --clear $(OLDEST); break; \
		fi; \
	done
	$(OLDEST)/bin/python -m pip install --quiet --disable-pip-version-check -e ".[test]" $$($(OLDEST)/bin/python tests/oldest.py)
	@touch $@

$(VENV)/.installed-for-benchmarks: pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[bench]"
	@touch $@ $(VENV)/.installed

# System packages: installed where apt is there and we may, else named. The modeller may do without (a driver may bring its
# own), the tests may not.
system-run:
	@$(call install,$(LIBRARIES) $(NEEDS_PYTHON)) || true

system-test:
	@$(call install,$(LIBRARIES) $(DISPLAYS) $(NEEDS_PYTHON))
	@command -v xvfb-run >/dev/null && command -v xdotool >/dev/null || \
		{ echo "The tests need Xvfb (xvfb-run, xauth) and xdotool: please install them." >&2; exit 1; }

define install
missing=; \
if command -v dpkg-query >/dev/null; then \
	for package in $(1); do \
		dpkg-query -W -f '$${Status}' $$package 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$package"; \
	done; \
fi; \
if [ -z "$$missing" ]; then true; \
elif [ "$$(id -u)" -eq 0 ] && command -v apt-get >/dev/null; then \
	echo "Installing$$missing"; export DEBIAN_FRONTEND=noninteractive; \
	apt-get update -qq && apt-get install -y -qq --no-install-recommends $$missing >/dev/null; \
else echo "Please install:$$missing  (sudo apt-get install$$missing)" >&2; false; fi
endef
