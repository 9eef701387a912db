#!/usr/bin/env bash
# Load on a service on loopback: tests/load/load.sh MIST [SECONDS]
# Needs wrk (Debian: wrk), curl and python3. Prints for each kind of request what wrk measured with
# 32 connections over SECONDS (30), the processor time of the service per request, and the memory of
# the service; SECONDS=300 shows whether it grows. Exits with 1 if a response is an error.
set -euo pipefail
mist="$1"
seconds="${2:-30}"
here="$(cd "$(dirname "$0")" && pwd)"
folder="$(mktemp -d)"
"$mist" serve --listen 127.0.0.1:0 2>"$folder/log" &
server=$!
trap 'kill $server; rm -r "$folder"' EXIT
until url="$(grep -o 'http://[0-9.:]*' "$folder/log")"; do sleep 0.1; done

put() { curl -sSf -o /dev/null -X PUT -d "$2" "$url/v1/materials/$1"; }
put glass '{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)","sdf.s":0.3}}'
put white '{"model":"Lambertian_BRDF_Model"}'
python3 "$here/pairs.py" 1 >"$folder/one"
python3 "$here/pairs.py" 10000 >"$folder/batch"

memory() { awk '/^VmRSS/ { print $2 " kB" }' "/proc/$server/status"; }
ticks() { awk '{ print $14 + $15 }' "/proc/$server/stat"; }

failed=0
# load TITLE PATH [BODY]
load() {
  printf '\n== %s\n' "$1"
  echo "memory before: $(memory)"
  local before
  before="$(ticks)"
  BODY="${3:-}" wrk -t 1 -c 32 -d "${seconds}s" --timeout 10s --latency -s "$here/post.lua" "$url$2" | tee "$folder/report"
  awk -v ticks="$(($(ticks) - before))" -v hertz="$(getconf CLK_TCK)" \
    '/requests in/ { printf "processor time of the service: %.1f us per request\n", 1e6 * ticks / hertz / $1 }' "$folder/report"
  echo "memory after: $(memory)"
  if grep -E 'Non-2xx|Socket errors' "$folder/report"; then failed=1; fi
}

fine='out=rgb&lambda=400:10:700'
coarse='out=rgb&lambda=450:100:650'
load 'single geometries, RGB of 31 wavelengths, microfacets' "/v1/materials/glass/evaluate?$fine" "$folder/one"
load 'batches of 10,000 geometries, RGB of 3 wavelengths, diffuser' "/v1/materials/white/evaluate?$coarse" "$folder/batch"
load 'batches of 10,000 geometries, RGB of 31 wavelengths, diffuser' "/v1/materials/white/evaluate?$fine" "$folder/batch"
load 'batches of 10,000 geometries, RGB of 31 wavelengths, microfacets' "/v1/materials/glass/evaluate?$fine" "$folder/batch"
load 'a table that is kept, 91 rows' '/v1/materials/glass/table.mtab?thetai=45&thetas=0:5:90&phis=0:45:180&lambda=400:10:700'
exit $failed
