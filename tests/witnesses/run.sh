#!/usr/bin/env bash
# Compares the models with independent programs from PyPI, in an environment of its own.
#
#     tests/witnesses/run.sh [FOLDER]
#
# FOLDER keeps the environment for the next run; without it a temporary one is made and removed.
set -euo pipefail
cd "$(dirname "$0")/../.."

if [ $# -gt 0 ]; then
    environment=$1
else
    environment=$(mktemp -d)
    trap 'rm -rf "$environment"' EXIT
fi
[ -x "$environment/bin/python" ] || python3 -m venv "$environment"
"$environment/bin/pip" install --quiet -r tests/witnesses/requirements.txt
cargo build --release -p mist-server
"$environment/bin/python" tests/witnesses/witnesses.py "${CARGO_TARGET_DIR:-target}/release/mist"
