import { execFileSync } from 'node:child_process';
import { existsSync } from 'node:fs';

/** The program that PRT names, as ctest does. */
const kPrt = process.env.PRT ?? '';
export const hasPrt = existsSync(kPrt);

/** Runs prt in a folder; what it says on stdout. */
export function runPrt(folder: string, ...words: string[]): string {
    return execFileSync(kPrt, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}
