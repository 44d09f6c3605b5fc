// Asks Khronos' glTF validator about files:
//
//   node validate.js FILE...                 prints errors and warnings; exit code 1 if there are any
//   node validate.js --must-complain FILE... the control: exit code 1 unless every file has an error
//
// Exit code 77 where the validator is not installed (npm ci).
'use strict';
const fs = require('fs');
const path = require('path');

let validator;
try {
  validator = require('gltf-validator');
} catch (error) {
  console.log('not installed: gltf-validator (scripts/setup --tests)');
  process.exit(77);
}

const SEVERITIES = ['error', 'warning'];

async function check(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 20});
  for (const {severity, code, message, pointer} of report.issues.messages) {
    if (severity < SEVERITIES.length) console.log(`${path.basename(file)}: ${SEVERITIES[severity]} ${code} at ${pointer}: ${message}`);
  }
  return report.issues;
}

async function main() {
  const files = process.argv.slice(2);
  const mustComplain = files[0] === '--must-complain';
  if (mustComplain) files.shift();
  if (files.length === 0) throw new Error('no files given');
  let failed = 0;
  for (const file of files) {
    const {numErrors, numWarnings} = await check(file);
    if (mustComplain ? numErrors === 0 : numErrors + numWarnings > 0) ++failed;
  }
  console.log(`${files.length} files checked, ${failed} failed`);
  process.exit(failed === 0 ? 0 : 1);
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
