#!/usr/bin/env bash
# Installs the Debian and npm packages that are missing, and says which. Quick when nothing is.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [ -n "${FRACBENCH_SKIP_INSTALL:-}" ]; then
  echo "FRACBENCH_SKIP_INSTALL is set: nothing is installed"
  exit 0
fi

system=$(. /etc/os-release 2>/dev/null && echo "${ID:-unknown} ${VERSION_ID:-}" || echo unknown)
if ! command -v apt-get >/dev/null || [ "$system" != "debian 12" ]; then
  {
    echo "This is '$system'; the set-up knows 'debian 12' only. Install what corresponds to these packages"
    wanted_packages | sed 's/^/  /'
    echo "and call this again with FRACBENCH_SKIP_INSTALL=1. The shape 'bunny' and the viewer of reports come from npm:"
    echo "  npm install --prefix third_party && mkdir -p data &&"
    echo "  node scripts/make_bunny.mjs third_party/node_modules data/bunny.obj"
  } >&2
  exit 2
fi

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

missing=()
for package in $(wanted_packages); do
  # A node or npm from elsewhere serves as well as Debian's.
  case $package in nodejs) command -v node >/dev/null && continue ;; npm) command -v npm >/dev/null && continue ;; esac
  is_installed "$package" || missing+=("$package")
done

if [ ${#missing[@]} -gt 0 ]; then
  say "installing Debian packages: ${missing[*]}"
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "Installing needs root: run this script as root, or install sudo, or have an administrator run" >&2
      echo "  apt-get install ${missing[*]}" >&2
      exit 2
    }
    as_root=(sudo)
  fi
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  "${as_root[@]}" apt-get update -q >"$log" 2>&1 &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -q --no-install-recommends "${missing[@]}" >>"$log" 2>&1 || {
    tail -20 "$log" >&2
    echo "apt-get failed; the packages wanted are: ${missing[*]}" >&2
    exit 2
  }
fi

npm_packages_are_there() {
  node -e 'const fs = require("fs"), wanted = require("./third_party/package.json").dependencies;
    for (const [name, version] of Object.entries(wanted)) {
      const file = `third_party/node_modules/${name}/package.json`;
      if (!fs.existsSync(file) || JSON.parse(fs.readFileSync(file)).version !== version) process.exit(1);
    }'
}

if ! npm_packages_are_there; then
  say "installing npm packages: $(node -p 'Object.entries(require("./third_party/package.json").dependencies).map(d => d.join(" ")).join(", ")')"
  npm install --prefix third_party --no-audit --no-fund --no-package-lock --silent
fi

if [ ! -s data/bunny.obj ]; then
  mkdir -p data
  node scripts/make_bunny.mjs third_party/node_modules data/bunny.obj
fi
