#!/bin/bash
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# run-tests.sh BUILD_FOLDER: every test of the release build, then what makes, reads and destroys things again with
# the address and undefined-behaviour sanitizers. The last line is "N passed, N failed, N skipped". With CI set, a
# test that skips fails: there, nothing may be missing.
set -euo pipefail
cd "$(dirname "$0")/.."
release=$1
sanitized=build/sanitize
# `objects` are tests of other suites that make and destroy much, `objects_floor` those that do so on the least OpenGL:
# what they show there, they show with the sanitizers, and with the release build on OpenGL as it is.
sanitized_suites=(base scene raster gpu objects objects_floor cli fuzz)

# Two tests share the processor: threads that wait leave it to the other.
export OMP_WAIT_POLICY=passive

run_meson_test() { # folder, meson test's options
    local folder=$1
    shift
    local log=$folder/meson-logs/testlog.json
    rm -f "$log"
    # Timeouts are for tests that hang: shared machines can be several times as slow as idle ones.
    # Failures are counted from the log, so the exit code is not needed; without a log it is an error.
    meson test -C "$folder" --no-rebuild --print-errorlogs --timeout-multiplier 4 "$@" || true
    if [ ! -s "$log" ]; then
        echo "tests: $folder ran no test" >&2
        exit 1
    fi
}

run_meson_test "$release" --no-suite=objects_floor

tools/build.sh "$sanitized" -Dbuildtype=debugoptimized -Db_sanitize=address,undefined -Db_lundef=false
# The runtime of GCC 12 takes the words before a thread-local block that begins 16 bytes into a page for its address and
# length, and crashes where it looks for leaks (google/sanitizers 1353): it is not to follow such blocks.
export ASAN_OPTIONS=${ASAN_OPTIONS:-abort_on_error=0:exitcode=99:detect_stack_use_after_return=1:intercept_tls_get_addr=0}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-halt_on_error=1:print_stacktrace=1}
run_meson_test "$sanitized" "${sanitized_suites[@]/#/--suite=}"

python3 tools/count-tests.py "$release/meson-logs/testlog.json" "$sanitized/meson-logs/testlog.json" |
    tee build/tests.log
