import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { type Picture, readPng } from '../../../support/picture.js';
import { runPrt } from '../../../support/prt.js';

/** A folder that prt works in. */
export class PrtFolder {
    private readonly path = mkdtempSync(join(tmpdir(), 'openprt-page-'));
    private readonly pictures = new Map<string, Picture>();

    run(words: string): string {
        return runPrt(this.path, ...words.split(/ +/));
    }

    read(name: string): Buffer {
        return readFileSync(this.of(name));
    }

    write(name: string, content: string | Uint8Array): void {
        writeFileSync(this.of(name), content);
    }

    of(name: string): string {
        return join(this.path, name);
    }

    url(name: string): string {
        return pathToFileURL(this.of(name)).href;
    }

    /** What `prt render` draws. */
    render(words: string): Picture {
        const found = this.pictures.get(words);
        if (found) return found;
        this.run(`render ${words} -o truth.png`);
        const picture = readPng(this.read('truth.png'));
        this.pictures.set(words, picture);
        return picture;
    }

    remove(): void {
        rmSync(this.path, { recursive: true });
    }
}
