#!/bin/sh
# Set certkit up in this checkout: the system libraries that are missing, a virtual environment in .venv, certkit in it.
#
#   sh setup.sh           to use it
#   sh setup.sh tests     to test it as well: with the test tools, a browser and a PDF reader
#
# It says what it installs. Where it may not install system packages it says so in one line and goes on:
# certkit then writes everything but the PDF, and the tests that need a missing part are skipped.
set -eu
cd "$(dirname "$0")"

what=${1:-use}
case $what in
  use | tests) ;;
  *) echo "setup.sh: \`$what\` is not known; write \`sh setup.sh\` or \`sh setup.sh tests\`" >&2; exit 2 ;;
esac

python=${PYTHON:-python3}
if ! command -v "$python" >/dev/null; then
  echo "setup.sh: no $python here; install Python 3.11 or newer, or name one: PYTHON=/path/to/python sh setup.sh" >&2
  exit 2
fi
if ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
  echo "setup.sh: certkit needs Python 3.11 or newer; $("$python" --version 2>&1) is here. Name another: PYTHON=… sh setup.sh" >&2
  exit 2
fi

has_library() { "$python" -c 'import ctypes, sys; ctypes.CDLL(sys.argv[1])' "$1" 2>/dev/null; }
has_program() { command -v "$1" >/dev/null; }

packages=
"$python" -c 'import ensurepip, venv' 2>/dev/null || packages="$packages python3-venv"
if [ "$(uname -s)" = Linux ]; then
  has_library libpango-1.0.so.0 || packages="$packages libpango-1.0-0"
  has_library libpangoft2-1.0.so.0 || packages="$packages libpangoft2-1.0-0"
  has_library libharfbuzz-subset.so.0 || packages="$packages libharfbuzz-subset0"
  if [ "$what" = tests ]; then
    has_program chromium || has_program chromium-browser || packages="$packages chromium"
    has_program pdftotext || packages="$packages poppler-utils"
    has_library libatomic.so.1 || packages="$packages libatomic1" # the browser's driver needs it
  fi
fi
packages=${packages# }

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi; }
may_install() { has_program apt-get && { [ "$(id -u)" = 0 ] || { has_program sudo && sudo -n true 2>/dev/null; }; }; }

if [ -n "$packages" ]; then
  if may_install; then
    echo "setup.sh: installing system packages: $packages" >&2
    # shellcheck disable=SC2086  # a list of words
    if ! { as_root apt-get update -qq &&
      as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages; } >.setup.log 2>&1; then
      tail -n 5 .setup.log >&2
      echo "setup.sh: that failed; going on without them" >&2
    fi
    rm -f .setup.log
  else
    echo "setup.sh: missing and not mine to install: $packages (as root: apt-get install $packages)" >&2
  fi
fi

[ -x .venv/bin/python ] || "$python" -m venv .venv
if [ "$what" = tests ]; then
  echo "setup.sh: installing certkit with its test tools into .venv; some minutes the first time" >&2
  .venv/bin/python -m pip install --quiet --editable '.[test,lint,docs]'
else
  echo "setup.sh: installing certkit into .venv; a minute or two the first time" >&2
  .venv/bin/python -m pip install --quiet .
fi
