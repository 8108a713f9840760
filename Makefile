# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# Short names for common tasks; everything is in tools/ and Meson's files. `make help` lists them.

SHELL := /bin/bash
BUILD := build/release
TERRELLA := build/terrella
DATA := $(or $(TERRELLA_DATA),$(or $(XDG_CACHE_HOME),$(HOME)/.cache)/terrella/data)
BODIES ?= all
SIZE ?= 1920x1080
VIEWS ?= orbit himalaya-morning rockies-sunset

# Mesa compiles shaders at the first draw, which takes longer than drawing; what it made is kept.
export MESA_SHADER_CACHE_DIR ?= $(or $(XDG_CACHE_HOME),$(HOME)/.cache)/terrella/shaders

.PHONY: help setup build data demo view test bench validate gallery clean

help: ## lists these tasks
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 16

setup: ## installs the packages that are missing (root or sudo)
	@tools/install-packages.sh $(PARTS)

build: setup ## builds the program: build/terrella
	@tools/build.sh $(BUILD) $(if $(CI),-Dwerror=true)
	@mkdir -p "$$MESA_SHADER_CACHE_DIR"
	@ln -sfn release/terrella $(TERRELLA)

data: build ## fetches data of all bodies into the cache; BODIES="earth mars" for some
	@tools/fetch-data.sh $(BUILD)/tools/prepare-data $(BODIES)
	@echo "data: $(DATA); licences: data/LICENCES.md; more: docs/data.md"

demo: build ## three pictures of Earth in demo/, then the viewer where there is a display
	@tools/fetch-data.sh $(BUILD)/tools/prepare-data
	@tools/demo.sh $(TERRELLA) $(SIZE) $(VIEWS)

view: build ## opens Earth in the viewer
	@tools/fetch-data.sh $(BUILD)/tools/prepare-data
	@$(TERRELLA) view scenes/earth.json

# The part of tools/packages.txt; `setup` sees it too.
test: PARTS := test
test: build ## every test; the last line counts them
	@tools/fetch-data.sh $(BUILD)/tools/prepare-data
	@tools/run-tests.sh $(BUILD)

bench: build ## measures speed and memory, prints tables; BENCH=papers beside published numbers
	@tools/fetch-data.sh $(BUILD)/tools/prepare-data
	@$(TERRELLA) bench $(BENCH)

validate: build ## compares the models of the sky with the path tracer: report.html, nine minutes
	@$(TERRELLA) validate --html report.html $(VALIDATE)

# The part of tools/packages.txt.
gallery: PARTS := gallery
gallery: build ## makes the pictures of docs/gallery again; GALLERY="mars venus" for some
	@tools/fetch-data.sh $(BUILD)/tools/prepare-data $(BODIES)
	@tools/gallery.sh $(TERRELLA) $(GALLERY)

clean: ## removes what was built, not the data
	rm -rf build demo
