# Harvester Lab. `make help` lists the targets.
SHELL := /usr/bin/env bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
.PHONY: help serve build dev serve-dev watch test check lint native-test page-test bench fmt clean

PORT ?= 8080
DEV_DIST := target/page-dev-dist
# Modules that a macro declares, which `cargo fmt` does not find by itself.
DECLARED := $(wildcard src/app/panels/*.rs src/questions/*.rs)
# The project's own tools first: wasm-opt of the distribution is often too old.
export PATH := $(CURDIR)/.tools/bin:$(CURDIR)/node_modules/.bin:$(PATH)
# Trunk understands NO_COLOR=true only, not the usual 1.
unexport NO_COLOR
# Panic messages name source files: those of other crates without the builder's home. Cargo joins this to the flags of
# .cargo/config.toml (RUSTFLAGS would replace them). It splits at spaces, so a home with one is left as it is.
CRATES := $(or $(CARGO_HOME),$(HOME)/.cargo)/registry/src
ifeq ($(words $(CRATES)),1)
export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS := --remap-path-prefix=$(CRATES)=crates
endif

help: ## this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | awk -F ':.*## ' '{ printf "  make %-11s %s\n", $$1, $$2 }'

serve: build ## build the page and serve it on http://127.0.0.1:8080/ (PORT=...)
	@echo "Harvester Lab: http://127.0.0.1:$(PORT)/ (Ctrl-C stops)"
	@python3 -m http.server --bind 127.0.0.1 --directory dist $(PORT)

build: ## build the page into dist/, ready for any static host (first time 5-15 minutes, with its tools)
	@scripts/tools.sh page
	trunk build --release --cargo-profile page

dev: ## build the page quickly into target/page-dev-dist/ (not optimised by wasm-opt)
	@scripts/tools.sh dev
	trunk build --cargo-profile page-dev --dist $(DEV_DIST)

serve-dev: dev ## the same, served
	@echo "Harvester Lab: http://127.0.0.1:$(PORT)/ (Ctrl-C stops)"
	@python3 -m http.server --bind 127.0.0.1 --directory $(DEV_DIST) $(PORT)

watch: ## the same, built and shown anew at every change of a source
	@scripts/tools.sh dev
	trunk serve --cargo-profile page-dev --dist $(DEV_DIST) --port $(PORT) --watch index.html --watch assets \
	  --watch src --watch solver/src --watch Cargo.toml

test: ## everything that is checked: format, lints, documentation, tests, page, browser tests, page weight
	@scripts/tools.sh test
	@scripts/timed.sh "format, lints, documentation, native tests" $(MAKE) --no-print-directory check
	@scripts/timed.sh "page" $(MAKE) --no-print-directory build
	@scripts/timed.sh "browser tests" $(MAKE) --no-print-directory page-test

check: lint native-test ## the part of `make test` that needs no browser

lint: ## format, lints (native, without the page, in the page), documentation
	cargo fmt --all --check -- $(DECLARED)
	cargo clippy --workspace --locked --quiet --all-targets --features app -- -D warnings
	cargo clippy --workspace --locked --quiet --all-targets -- -D warnings
	CLIPPY_CONF_DIR=scripts/wasm cargo clippy --workspace --locked --quiet --lib --bins --features app --target wasm32-unknown-unknown -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --locked --quiet --no-deps --features app

native-test: ## the tests that need no browser
	cargo test --workspace --locked --quiet --features app

page-test: ## the browser tests on what is in dist/
	@scripts/tools.sh browser
	cargo test --locked --quiet --features app --test browser -- --ignored --test-threads=1 --nocapture

bench: ## measurements (minutes)
	cargo bench --workspace --locked

fmt: ## format the sources
	cargo fmt --all -- $(DECLARED)

clean: ## remove what was built; the tools stay
	rm -rf target dist
