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

/** How many numbers of red, green and blue are seen. */
function countSeen(pixels: number[]): number {
    return pixels.filter((value, i) => i % 4 < 3 && value > 0.01).length;
}

/** The transfer of golden assets may be negative: one of the two is seen. */
function lightAndItsNegative(): object[] {
    const { lighting } = vectors.assets[0] as any;
    return [1, -1].map((sign) => ({ ...lighting, coefficients: lighting.coefficients.map((rgb: number[]) => rgb.map((value) => sign * value)) }));
}

describe.skipIf(!hasBrowser)('in Chromium', () => {
    let opened: OpenPage;
    beforeAll(async () => {
        opened = await openPage();
    }, 60000);
    afterAll(() => opened?.close());

    const draw = (file: string, mode: 'gpu' | 'cpu', lighting: unknown): Promise<Record<string, number[]>> =>
        opened.page.evaluate(`window.draw(${JSON.stringify(`/golden/${file}`)}, { mode: "${mode}", gloss: false }, ${JSON.stringify(lighting)})`);

    it.each(kVersions.flatMap((version) => kEncodings.map((encoding) => `${version}-${encoding}.prt.glb`)))(
        '%s looks the same summed by the shader and on the CPU',
        async (file) => {
            let seen = 0;
            for (const lighting of lightAndItsNegative()) {
                const byShader = await draw(file, 'gpu', lighting);
                const onCpu = await draw(file, 'cpu', lighting);
                expect(Object.keys(byShader)).toEqual(Object.keys(onCpu));
                expect(Object.keys(byShader).length).toBe(file.startsWith('1.2') ? 4 : 2);
                for (const transport of Object.keys(byShader)) {
                    seen += countSeen(byShader[transport]) / Object.keys(byShader).length;
                    expect(largestDifference(byShader[transport], onCpu[transport])).toBeLessThan(kRounding);
                }
            }
            expect(seen).toBeGreaterThan(1000);
            expect(opened.complaints).toEqual([]);
        },
    );

    it.each([['glossy-shadowed', 1, 0.5], ['glossy', 0, 0.3], ['glossy', 0.5, 1]])(
        '%s transport shines in the shader as on the CPU, at metallic %d and roughness %d',
        async (transport, metalness, roughness) => {
            let seen = 0;
            for (const lighting of lightAndItsNegative()) {
                const { byShader, onCpu }: Record<string, number[]> = await opened.page.evaluate(
                    `window.drawGloss("/golden/1.2-unorm8.prt.glb", "${transport}", ${JSON.stringify(lighting)}, { metalness: ${metalness}, roughness: ${roughness} })`,
                );
                seen += countSeen(byShader);
                // Negative radiance is cut off at pixels.
                expect(largestDifference(byShader, onCpu.map((value) => Math.max(value, 0)))).toBeLessThan(kGloss);
            }
            expect(seen).toBeGreaterThan(1000);
            expect(opened.complaints).toEqual([]);
        },
    );

    it('a lost and restored context shows the same', async () => {
        const { lighting } = vectors.assets[0] as any;
        const { before, after }: Record<string, number[]> = await opened.page.evaluate(
            `window.drawThroughLoss("/golden/1.1-unorm8.prt.glb", ${JSON.stringify(lighting)})`,
        );
        expect(countSeen(before)).toBeGreaterThan(1000);
        expect(after).toEqual(before);
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
