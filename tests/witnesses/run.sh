#!/usr/bin/env bash
# Compares the models with independent programs from PyPI, in separate environments.
#
#     tests/witnesses/run.sh [FOLDER]
#
# FOLDER keeps the environments for the next run; without it temporary ones are made and removed.
# Particles on surfaces are compared with smuthi, which builds with gfortran and with Python 3.8 to
# 3.10 only; OLDER_PYTHON names one that is not on the path.
set -euo pipefail
cd "$(dirname "$0")/../.."

if [ $# -gt 0 ]; then
    folder=$1
else
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
fi

# environment NAME PYTHON FIRST...: an environment, with FIRST installed before everything else
environment() {
    local place=$folder/$1 python=$2
    shift 2
    [ -x "$place/bin/python" ] || "$python" -m venv "$place"
    [ $# -eq 0 ] || "$place/bin/pip" install --quiet "$@"
}

older_python() {
    local python
    for python in ${OLDER_PYTHON:-} python3.10 python3.9 python3.8; do
        if "$python" -c "" 2>/dev/null; then
            echo "$python"
            return
        fi
    done
}

cargo build --release --workspace
mist=${CARGO_TARGET_DIR:-target}/release/mist
failed=0

environment present python3
"$folder/present/bin/pip" install --quiet -r tests/witnesses/requirements.txt
"$folder/present/bin/python" tests/witnesses/witnesses.py "$mist" || failed=1

older=$(older_python)
if [ -n "$older" ] && command -v gfortran >/dev/null; then
    # smuthi's own recipe needs numpy.distutils, which later versions no longer have.
    environment older "$older" "setuptools<60" "numpy<1.24" wheel
    "$folder/older/bin/pip" install --quiet --no-build-isolation \
        -r tests/witnesses/requirements-surfaces.txt
    # Its Fortran leaves files where it runs.
    here=$PWD mist=$(realpath "$mist")
    (cd "$folder" && older/bin/python "$here/tests/witnesses/surfaces.py" "$mist") || failed=1
else
    echo "NOT COMPARED: particles on surfaces, for want of Python 3.8 to 3.10 or of gfortran"
fi
exit $failed
