#!/usr/bin/env bash
# Makes viewer.js anew, for developers; needs node and npm. Users of ivconvert need neither.
set -euo pipefail
cd "$(dirname "$0")"
npm ci --no-audit --no-fund --silent
{
  echo '/* Viewer of ivconvert (MIT OR Apache-2.0), with three.js and its meshoptimizer decoder:'
  sed 's/^/ * /; s/ *$//' node_modules/three/LICENSE
  echo ' *'
  echo ' * meshoptimizer: Copyright (C) 2016-2026, by Arseny Kapoulkine; the same licence. */'
  npx --no-install esbuild viewer.src.js --bundle --minify --format=iife --target=es2020 \
    --legal-comments=none --log-level=warning
} > viewer.js
