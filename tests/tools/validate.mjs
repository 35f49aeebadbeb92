// The Khronos glTF validator over files: one JSON line a file on standard output.
//
//   node validate.mjs FILE...          or          node validate.mjs --list NAMES.txt
//
// A line holds `file`, the counts `errors`, `warnings`, `infos` and `hints`, and `first`, the
// first error or warning in words (null without one). A file that cannot be read at all has one
// error. Exit code: 0 no error and no warning anywhere, 1 some, 2 the validator itself is missing.

import { readFile } from 'node:fs/promises';
import { basename, dirname, resolve } from 'node:path';

const validator = await import('gltf-validator').then(
  (module) => module.default,
  () => {
    console.error('gltf-validator is not installed: npm ci --prefix tests/tools');
    process.exit(2);
  },
);

/** Severities of the validator's messages. */
const WARNING = 1;

async function namesFrom([first, ...rest]) {
  if (first !== '--list') return first === undefined ? [] : [first, ...rest];
  const text = await readFile(rest[0], 'utf8');
  return text.split('\n').filter((name) => name !== '');
}

async function bytesOf(path) {
  return new Uint8Array(await readFile(path));
}

function inWords({ code, message, pointer }) {
  return `${code} ${pointer ?? ''} ${message}`;
}

async function lineFor(file) {
  try {
    const report = await validator.validateBytes(await bytesOf(file), {
      uri: basename(file),
      // Enough to meet an error or warning behind notes; the counts are complete in any case.
      maxIssues: 1000,
      externalResourceFunction: (uri) => bytesOf(resolve(dirname(file), decodeURIComponent(uri))),
    });
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    const worst = messages.find(({ severity }) => severity <= WARNING);
    return {
      file,
      errors: numErrors,
      warnings: numWarnings,
      infos: numInfos,
      hints: numHints,
      first: worst === undefined ? null : inWords(worst),
    };
  } catch (error) {
    return { file, errors: 1, warnings: 0, infos: 0, hints: 0, first: String(error) };
  }
}

let clean = true;
for (const file of await namesFrom(process.argv.slice(2))) {
  const line = await lineFor(file);
  clean &&= line.errors === 0 && line.warnings === 0;
  console.log(JSON.stringify(line));
}
process.exitCode = clean ? 0 : 1;
