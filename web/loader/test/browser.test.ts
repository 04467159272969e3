import { readFileSync } from 'node:fs';

import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { joinGlb, openGlb } from './support/glb_file.js';
import { type OpenPage, hasBrowser } from '../../support/chromium.js';
import { openPage } from './support/browser.js';
import { goldenBytes, kEncodings, kVersions } from './support/golden.js';
import { largestDifference, vectors } from './support/vectors.js';

// Floats on both sides; radiance is of magnitude 1 to 10.
const kRounding = 1e-5;
// Views are normalised and turned in floats, and lobes are steep at the horizon.
const kGloss = 1e-4;
// GPUs decode texels from sRGB with some bits less.
const kTexels = 1e-4;
// Lobes are tables to a thousandth here and in the library, and GPUs filter bytes as such; pixels are up to 1.2.
const kLobes = 0.02;

/** The transfer of golden assets may be negative: one of the two is seen. */
function lightAndItsNegative(): object[] {
    const { lighting } = vectors.assets[0] as any;
    return [1, -1].map((sign) => ({ ...lighting, coefficients: lighting.coefficients.map((rgb: number[]) => rgb.map((value) => sign * value)) }));
}

/** What the page found: how much was seen, and the largest difference of two pictures. */
interface Comparison {
    transports: string[];
    seen: number;
    difference: number;
    /** What is left of the first after its copy was disposed of, and after it was itself. */
    leftAlone: number;
    again: number;
}

describe.skipIf(!hasBrowser)('in Chromium', () => {
    let opened: OpenPage;
    beforeAll(async () => {
        opened = await openPage();
    }, 60000);
    afterAll(() => opened?.close());

    function callPage<Result = Comparison>(name: string, ...parameters: unknown[]): Promise<Result> {
        return opened.page.evaluate(`window.${name}(${parameters.map((parameter) => JSON.stringify(parameter)).join()})`);
    }

    it.each(kVersions.flatMap((version) => kEncodings.map((encoding) => `${version}-${encoding}.prt.glb`)))(
        '%s looks the same summed by the shader and on the CPU',
        async (file) => {
            const { transports, seen, difference } = await callPage('compareSums', `/golden/${file}`, lightAndItsNegative());
            // Normals tell one more than is stored.
            expect(transports.length).toBe(file.startsWith('1.2') ? 5 : 3);
            expect(seen / transports.length).toBeGreaterThan(1000);
            expect(difference).toBeLessThan(kRounding);
            expect(opened.complaints).toEqual([]);
        },
    );

    it.each([['glossy-shadowed', 1, 0.5], ['glossy', 0, 0.3], ['glossy', 0.5, 1]])(
        '%s transport shines in the shader as on the CPU, at metallic %d and roughness %d',
        async (transport, metalness, roughness) => {
            const surface = { metalness, roughness };
            const { seen, difference } = await callPage('compareGloss', '/golden/1.2-unorm8.prt.glb', transport, lightAndItsNegative(), surface);
            expect(seen).toBeGreaterThan(1000);
            expect(difference).toBeLessThan(kGloss);
            expect(opened.complaints).toEqual([]);
        },
    );

    it('textures, vertex colours and holes are where the library sees them, and metal and roughness too', async () => {
        const [shown] = vectors.shownSurfaces as any[];
        const pictures: Record<string, number[]> = await callPage('drawFromAbove', shown.file, shown.lighting, shown.size, shown.metres);
        expect(Object.keys(pictures)).toEqual(['unshadowed', ...Object.keys(shown.pictures)]);
        for (const [transport, pixels] of Object.entries<number[]>(shown.pictures)) {
            expect(pixels.filter((value) => value > 0.1).length).toBeGreaterThan(200);
            expect(pixels.filter((value) => value === 0).length).toBeGreaterThan(30);
            expect(largestDifference(pictures[transport], pixels)).toBeLessThan(transport.startsWith('glossy') ? kLobes : kTexels);
        }
        expect(opened.complaints).toEqual([]);
    });

    it.each([{}, { gloss: false }, { mode: 'cpu' }])('an asset and its copy, made with %j, are lit each by itself', async (options) => {
        const { seen, difference, leftAlone, again } = await callPage('compareClone', '/golden/1.2-unorm8.prt.glb', options, lightAndItsNegative());
        expect(seen).toBeGreaterThan(1000);
        expect(difference).toBe(0);
        expect([leftAlone, again]).toEqual([0, 0]);
        expect(opened.complaints).toEqual([]);
    });

    it('a lost and restored context shows the same', async () => {
        const { seen, difference } = await callPage('compareThroughLoss', '/golden/1.1-unorm8.prt.glb', lightAndItsNegative()[0]);
        expect(seen).toBeGreaterThan(1000);
        expect(difference).toBe(0);
        const said = opened.complaints.splice(0);
        expect(said.filter((complaint) => !/context (was )?lost|context (was )?restored|CONTEXT_LOST/i.test(complaint))).toEqual([]);
    });

    it('a plain glTF loads as ever, and has nothing to relight', async () => {
        const file = openGlb(goldenBytes('1.2', 'unorm8'));
        delete file.json.extensions;
        const bytes = joinGlb(file);
        expect(await opened.page.evaluate(`window.loadPlain([${bytes.join()}])`)).toMatch(/^2 nodes; the file has no radiance transfer/);
        expect(opened.complaints).toEqual([]);
    });

    it('the example of the README works', async () => {
        const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
        const [, code] = /```js\n([^]*?)```/.exec(readme)!;
        const origin = new URL(opened.page.url()).origin;
        const module = code.replace('scene.prt.glb', `${origin}/golden/1.2-unorm8.prt.glb`);
        expect(await opened.page.evaluate(`window.runModule(${JSON.stringify(module)})`)).toBeGreaterThan(100);
        expect(opened.complaints).toEqual([]);
    });

    it('a damaged asset fails to load, with the sentence of the reader', async () => {
        const bytes = goldenBytes('1.2', 'unorm8');
        bytes[bytes.length - 200] ^= 1;
        expect(await opened.page.evaluate(`window.refusalOf([${bytes.join()}])`)).toMatch(/OpenPrtError: buffer view \d+ is damaged/);
        expect(opened.complaints).toEqual([]);
    });
});
