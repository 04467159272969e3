// Holds glTF files to the Khronos validator:  node tools/validate_gltf.mjs FILE.glb…
// Prints every error and warning, and one line a file; exits with 1 if there is any. `npm ci` in tools/ installs it.
import { readFileSync } from 'node:fs';
import { validateBytes } from 'gltf-validator';

const files = process.argv.slice(2);
if (files.length === 0) {
    console.error('usage: node tools/validate_gltf.mjs FILE.glb...');
    process.exit(2);
}

const severities = ['error', 'warning', 'information', 'hint'];
let isClean = true;
for (const file of files) {
    const report = await validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 100 }).catch((failure) => {
        console.error(`${file}: ${failure}`);
        process.exit(1);
    });
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} informations, ${numHints} hints`);
    for (const { severity, code, message, pointer } of messages)
        if (severity < 2) console.log(`  ${severities[severity]} ${code} at ${pointer ?? 'the file'}: ${message}`);
    isClean &&= numErrors + numWarnings === 0;
}
process.exit(isClean ? 0 : 1);
