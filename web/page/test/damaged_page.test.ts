import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { type GlbFile, headerOf, joinGlb, openGlb, repairChecksums } from '../../loader/test/support/glb_file.js';
import { hasBrowser, openChromium } from '../../support/chromium.js';
import { hasPrt } from '../../support/prt.js';
import { makeBlock } from './support/blocks.js';
import { PrtFolder } from './support/prt_folder.js';
import { ShownPage } from './support/shown_page.js';

/** Seconds are few: a page that hangs is worse than one that says what is wrong. */
const kMostMilliseconds = 15000;

describe.skipIf(!hasBrowser || !hasPrt)('a page that is damaged', () => {
    const folder = new PrtFolder();
    let page: ShownPage;
    let whole: string;
    let asset: Uint8Array;

    beforeAll(async () => {
        makeBlock(folder);
        folder.run('web block.prt.glb block.prt.glb --light uniform:0.5 -o whole.html');
        whole = folder.read('whole.html').toString('latin1');
        asset = folder.read('block.prt.glb');
        page = new ShownPage(await openChromium('about:blank', { width: 320, height: 180 }));
        await page.opened.page.addInitScript(() => {
            if (!location.search.includes('without-webgl2')) return;
            const { getContext } = HTMLCanvasElement.prototype;
            HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...more: unknown[]) {
                return kind === 'webgl2' ? null : (getContext as any).call(this, kind, ...more);
            } as typeof getContext;
        });
    });
    afterAll(async () => {
        await page?.opened.close();
        folder.remove();
    });

    /** Opens the page with other text in an element that prt wrote. */
    const openWith = async (id: string, text: string, query = ''): Promise<void> => {
        const begin = whole.indexOf('>', whole.indexOf(`id="${id}"`)) + 1;
        expect(begin).toBeGreaterThan(1000);
        folder.write('damaged.html', Buffer.from(whole.slice(0, begin) + text + whole.slice(whole.indexOf('</script>', begin)), 'latin1'));
        await page.open(folder.url('damaged.html') + query);
    };
    const base64 = (bytes: Uint8Array): string => Buffer.from(bytes).toString('base64');
    const changed = (change: (file: GlbFile) => void, repair = true): Uint8Array => {
        const file = openGlb(asset);
        change(file);
        if (repair) repairChecksums(file);
        return joinGlb(file);
    };

    const kDamages: [string, () => Uint8Array, RegExp][] = [
        ['a changed byte', () => Uint8Array.from(asset, (byte, i) => (i === asset.length - 200 ? byte ^ 1 : byte)), /damaged/],
        ['half of it', () => asset.subarray(0, asset.length / 2), /./],
        ['its first bytes', () => asset.subarray(0, 10), /./],
        ['nothing', () => asset.subarray(0, 0), /./],
        ['text', () => new TextEncoder().encode('Dear reader, this is no glTF at all.'), /./],
        ['another version', () => changed((file) => (headerOf(file).version = '9.0')), /version/],
        ['no radiance transfer', () => changed((file) => delete file.json.extensions, false), /no radiance transfer|prt bake/],
        ['absurd bands', () => changed((file) => (headerOf(file).bands = 1e9)), /./],
        ['an absurd count', () => changed((file) => (file.json.accessors[0].count = 4e9), false), /./],
        ['an absurd view', () => changed((file) => (file.json.bufferViews[0].byteLength = 4e12), false), /./],
        ['no meshes', () => changed((file) => (file.json.meshes = []), false), /./],
    ];

    it.each(kDamages)('says of an asset of %s that it cannot be shown, and shows the other', async (_, damage, sentence) => {
        const begin = performance.now();
        await openWith('prt-asset-0', base64(damage()));
        await expect.poll(() => page.message()).toMatch(/^block.*\S\.$/);
        expect(performance.now() - begin).toBeLessThan(kMostMilliseconds);
        expect(await page.message()).toMatch(sentence);
        await page.show('asset=1');
        expect(await page.state()).toBe('ready');
        expect(page.opened.complaints).toEqual([]);
    });

    it('says that none of its assets can be shown', async () => {
        whole = whole.replace(/(<script [^>]*id="prt-asset-1"[^>]*>)[^<]*/, '$1AAAA');
        await openWith('prt-asset-0', 'no base64');
        expect(await page.state()).toBe('failed');
        expect(await page.message()).toMatch(/^block.*\S\.$/);
        expect(await page.opened.page.isVisible('#divider')).toBe(false);
        expect(page.opened.complaints).toEqual([]);
        whole = folder.read('whole.html').toString('latin1');
    });

    it.each([
        ['prt-data', '{"assets": [], "li'],
        ['prt-data', '[]'],
        ['prt-light-0', 'AAAA'],
    ])('says that %s is damaged', async (id, text) => {
        await openWith(id, text);
        expect(await page.state()).toBe('failed');
        expect(await page.message()).toMatch(/\S\.$/);
        expect(page.opened.complaints).toEqual([]);
    });

    it('says that the browser has no WebGL2', async () => {
        await page.open(`${folder.url('whole.html')}?without-webgl2`);
        expect(await page.state()).toBe('failed');
        expect(await page.message()).toMatch(/WebGL ?2/);
        expect(page.opened.complaints).toEqual([]);
    });

    it('refuses a wrong file with a sentence, keeps the picture, and then takes a right one', async () => {
        await page.open(`${folder.url('whole.html')}#ui=0`);
        const before = await page.picture();
        folder.write('wrong.glb', asset.subarray(0, 1000));
        await page.opened.page.setInputFiles('input[type=file]', folder.of('wrong.glb'));
        await expect.poll(() => page.message()).toMatch(/^wrong.*\S\.$/);
        expect(await page.state()).toBe('ready');
        await page.opened.page.addStyleTag({ content: '#message-box { display: none; }' });
        expect(await page.picture()).toEqual(before);
        await page.opened.page.setInputFiles('input[type=file]', folder.of('block.prt.glb'));
        await page.opened.page.waitForFunction(() => location.hash.includes('asset=2'));
        await page.settle();
        expect(page.opened.complaints).toEqual([]);
    });
});
