import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { type PreviewServer, build, preview } from 'vite';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { type OpenPage, hasBrowser, openChromium } from '../../support/chromium.js';
import { compare, readPng } from '../../support/picture.js';
import { hasPrt, runPrt } from '../../support/prt.js';

const root = fileURLToPath(new URL('..', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'openprt-example-'));

// One radiance a vertex, interpolated in floats by both: what differs is rounded to code values.
const kSmoothDecibels = 45;
const kWholeDecibels = 38;

/** The application as it is built for users, with scenes and lights beside it. */
describe.skipIf(!hasBrowser || !hasPrt)('the example, in Chromium', () => {
    let server: PreviewServer;
    let opened: OpenPage;

    beforeAll(async () => {
        const common = { root, logLevel: 'error', publicDir: false, build: { outDir: folder, emptyOutDir: true, chunkSizeWarningLimit: 2000 } } as const;
        await build(common);
        runPrt(folder, 'scene', 'teapot', '-o', 'teapot.glb');
        runPrt(folder, 'bake', 'teapot.glb', '-o', 'scene.prt.glb', '--samples', '64');
        runPrt(folder, 'compress', 'scene.prt.glb', '-o', 'small.prt.glb', '--method', 'u16', '--meshopt');
        writeFileSync(join(folder, 'light.json'), runPrt(folder, 'light', 'daylight:150,40', '--scale', '0.03', '--format', 'json'));
        runPrt(folder, 'light', 'sky:150,40', '--scale', '0.1', '--environment', 'sky.exr', '--size', '64');
        writeFileSync(join(folder, 'cut.prt.glb'), readFileSync(join(folder, 'small.prt.glb')).subarray(0, 100000));
        server = await preview({ ...common, preview: { port: 0, host: '127.0.0.1' } });
        opened = await openChromium('about:blank', { width: 640, height: 360 });
    });
    afterAll(async () => {
        await opened?.close();
        await server?.close();
        rmSync(folder, { recursive: true });
    });

    /** Opens the example, and waits for what it shows or says. */
    const open = async (query = ''): Promise<string> => {
        opened.complaints.length = 0;
        await opened.page.goto(server.resolvedUrls!.local[0] + query);
        await opened.page.addStyleTag({ content: 'label { display: none; }' });
        await opened.page.waitForFunction(`!document.querySelector('#message').textContent.startsWith('Loading')`);
        return (await opened.page.textContent('#message'))!;
    };
    const expectPicture = async (...light: string[]): Promise<void> => {
        runPrt(folder, 'render', 'scene.prt.glb', '--tone', 'neutral', '--size', '640x360', '-o', 'truth.png', ...light);
        const likeness = compare(readPng(await opened.page.screenshot()), readPng(readFileSync(join(folder, 'truth.png'))));
        expect(likeness.smoothPart).toBeGreaterThan(0.5);
        expect(likeness.smooth).toBeGreaterThan(kSmoothDecibels);
        expect(likeness.whole).toBeGreaterThan(kWholeDecibels);
        expect(opened.complaints).toEqual([]);
    };

    it('shows what prt render shows, and turns the light as it does', async () => {
        expect(await open('?light=light.json')).toBe('');
        await expectPicture('--light', 'light.json');
        await opened.page.evaluate(`turn.value = 90, turn.dispatchEvent(new Event('input'))`);
        await expectPicture('--light', 'light.json', '--rotate', '0,90,0');
    });

    it('projects a picture of the light, and reads what prt compress --meshopt wrote', async () => {
        expect(await open('?scene=small.prt.glb&light=sky.exr')).toBe('');
        await expectPicture('--light', 'sky.exr');
    });

    it('has a light of its own', async () => {
        expect(await open()).toBe('');
        const { data } = readPng(await opened.page.screenshot());
        expect(data.filter((value) => value > 50).length).toBeGreaterThan(data.length / 4);
        expect(opened.complaints).toEqual([]);
    });

    it.each([
        ['?scene=nowhere.glb', /^The scene cannot be shown\. fetch for .* responded with 404/],
        ['?light=nowhere.json', /^The scene cannot be shown\. nowhere.json is not there: 404/],
        ['?scene=teapot.glb', /^The scene cannot be shown\. the file has no radiance transfer/],
        ['?scene=cut.prt.glb', /^The scene cannot be shown\. /],
    ])('says of %s what is wrong', async (query, sentence) => {
        expect(await open(query)).toMatch(sentence);
        expect(opened.complaints.filter((complaint) => !complaint.includes('404'))).toEqual([]);
    });
});
