// Holds glTF files to the Khronos validator:  node tools/validate_gltf.mjs FILE.glb|FOLDER…
// Prints every error and warning, and how many files were read; exits with 1 if there is any, or if a folder has no .glb.
// `npm ci` in tools/ installs the validator.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { validateBytes } from 'gltf-validator';

const paths = process.argv.slice(2);
if (paths.length === 0) {
    console.error('usage: node tools/validate_gltf.mjs FILE.glb|FOLDER...');
    process.exit(2);
}
const files = paths.flatMap((path) => {
    if (!statSync(path).isDirectory()) return [path];
    const found = readdirSync(path).filter((name) => name.endsWith('.glb'));
    if (found.length === 0) throw new Error(`${path} has no .glb`);
    return found.map((name) => join(path, name));
});

const severities = ['error', 'warning', 'information', 'hint'];
let faultyCount = 0;
for (const file of files) {
    const report = await validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 100 }).catch((failure) => {
        console.error(`${file}: ${failure}`);
        process.exit(1);
    });
    const { numErrors, numWarnings, messages } = report.issues;
    if (numErrors + numWarnings === 0) continue;
    ++faultyCount;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
    for (const { severity, code, message, pointer } of messages)
        if (severity < 2) console.log(`  ${severities[severity]} ${code} at ${pointer ?? 'the file'}: ${message}`);
}
console.log(`${files.length} files were validated, ${faultyCount} have errors or warnings`);
process.exit(faultyCount === 0 ? 0 : 1);
