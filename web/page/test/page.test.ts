import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';

import { hasBrowser, openChromium } from '../../support/chromium.js';
import { type Picture, compare, crop } from '../../support/picture.js';
import { hasPrt } from '../../support/prt.js';
import { kAssets, makePage } from './support/blocks.js';
import { PrtFolder } from './support/prt_folder.js';
import { ShownPage } from './support/shown_page.js';

const kWidth = 480;
const kHeight = 270;

// Both interpolate one radiance a vertex: inside surfaces all that differs is how it is rounded to code values of 8 bits.
const kSmoothDecibels = 60;
const kWholeDecibels = 32;

/** Nothing but the picture, of what prt render shows when it is not told otherwise. */
const kPlain = 'ui=0&window=none&background=0&exposure=0';

/** The same, but for some keys. */
function plainBut(hash: string): string {
    const keys = new URLSearchParams(kPlain);
    new URLSearchParams(hash).forEach((value, key) => keys.set(key, value));
    return keys.toString();
}

describe.skipIf(!hasBrowser || !hasPrt)('the page of prt web, in Chromium', () => {
    const folder = new PrtFolder();
    let page: ShownPage;

    beforeAll(async () => {
        makePage(folder);
        page = new ShownPage(await openChromium('about:blank', { width: kWidth, height: kHeight }));
        await page.open(folder.url('page.html'));
    });
    afterAll(async () => {
        await page?.opened.close();
        folder.remove();
    });

    afterEach(async () => {
        page.opened.complaints.length = 0; // each test's are its own
        await page.opened.page.setViewportSize({ width: kWidth, height: kHeight });
    });

    const render = (words: string): Picture => folder.render(`${words} --size ${kWidth}x${kHeight}`);

    /** Holds the picture to that of prt render, and the page to silence; PRT_TELL=1 in the environment prints how alike they are. */
    const expectPicture = async (truth: Picture, part = (picture: Picture): Picture => picture): Promise<void> => {
        const likeness = compare(part(await page.picture()), part(truth));
        if (process.env.PRT_TELL) console.log(expect.getState().currentTestName, JSON.stringify(likeness));
        expect(likeness.smoothPart).toBeGreaterThan(0.7);
        expect(likeness.smooth).toBeGreaterThan(kSmoothDecibels);
        expect(likeness.whole).toBeGreaterThan(kWholeDecibels);
        expect(page.opened.complaints).toEqual([]);
        expect(await page.message()).toBe('');
    };
    const drag = async (dx: number, dy: number): Promise<void> => {
        const { mouse } = page.opened.page;
        await mouse.move(kWidth / 2, kHeight / 2);
        await mouse.down();
        for (const part of [0.3, 0.7, 1]) await mouse.move(kWidth / 2 + part * dx, kHeight / 2 + part * dy);
        await mouse.up();
    };

    it('opens from disk with a picture, exposed for the light', async () => {
        expect(await page.state()).toBe('ready');
        await page.show('light=2&ui=0&background=0&tone=none');
        // Of 0.5 from everywhere white surfaces reflect 0.5, to be shown as 0.8.
        await expectPicture(render(`block.prt.glb --light uniform:0.5 --tone none --exposure ${Math.log2(0.8 / 0.5)}`));
    });

    it.each([
        ['tone=none', '--tone none'],
        ['tone=aces&exposure=1.5', '--tone aces --exposure 1.5'],
        ['tone=neutral&exposure=1', '--tone neutral --exposure 1'],
        ['light=1', '--light sun.json'],
        ['turn=70', '--rotate 0,70,0'],
        ['turn=-130&tilt=40', '--rotate 40,-130,0'],
        ['transport=unshadowed', '--transport unshadowed'],
        ['transport=shadowed', '--transport shadowed'],
        ['transport=shadowed&light=1', '--transport shadowed --light sun.json'],
        ['window=hann', '--window hann'],
        ['window=lanczos&light=1', '--window lanczos --light sun.json'],
        ['window=auto&light=1', '--light sun-auto.json'],
        ['bands=2', '--light sky-2.json'],
        ['bands=3&window=hann', '--light sky-3.json --window hann'],
        ['eye=1.5,1,2&target=0,0.3,-0.5', '--eye 1.5,1,2 --target 0,0.3,-0.5 --fov FOV'],
    ])('shows #%s as prt render %s does', async (hash, words) => {
        await page.show(plainBut(hash));
        const light = words.includes('--light') ? '' : '--light sky.json';
        await expectPicture(render(`block.prt.glb ${light} ${words.replace('FOV', String(await page.verticalFovDegrees()))}`));
    });

    it.each(kAssets.slice(1).map((name, i) => [name, i + 1]))('shows the asset %s, number %d of the page, as prt render does', async (name, index) => {
        await page.show(`${kPlain}&asset=${index}&turn=20`);
        await expectPicture(render(`${name}.prt.glb --light sky.json --rotate 0,20,0`));
    });

    it('shows the light behind the asset, turned with it', async () => {
        await page.show('ui=0&window=none&exposure=0&light=2');
        await expectPicture(render('block.prt.glb --light uniform:0.5 --background'));
        // Of a picture it is a blur; it has nothing that is sharp, and is told apart by where it is bright.
        await page.show('ui=0&window=none&exposure=0&light=3&turn=100&tilt=20');
        const truth = render('block.prt.glb --light sky.exr --rotate 20,100,0 --background');
        const likeness = compare(await page.picture(), truth);
        expect(likeness.smooth).toBeGreaterThan(30);
        await page.show('ui=0&window=none&exposure=0&light=3&turn=-100&tilt=20');
        expect(compare(await page.picture(), truth).smooth).toBeLessThan(25);
    });

    it('shows two settings side by side', async () => {
        const split = kWidth / 4;
        await page.show(`${kPlain}&split=0.25&other.transport=shadowed&other.bands=2`);
        await expectPicture(render('block.prt.glb --light sky.json'), (picture) => crop(picture, 0, split - 2));
        await expectPicture(render('block.prt.glb --light sky-2.json --transport shadowed'), (picture) => crop(picture, split + 2, kWidth - split - 2));
        await page.show(`${kPlain}&split=0.5&other.asset=2`);
        await expectPicture(render('block.prt.glb --light sky.json'), (picture) => crop(picture, 0, kWidth / 2 - 2));
        await expectPicture(render('textured.prt.glb --light sky.json'), (picture) => crop(picture, kWidth / 2 + 2, kWidth / 2 - 2));
    });

    it('turns the light by a drag with Shift, and leaves the camera', async () => {
        await page.show(`${kPlain}&light=1`);
        const { keyboard } = page.opened.page;
        await keyboard.down('Shift');
        await drag(60, 20);
        await keyboard.up('Shift');
        await page.waitForAddress();
        const keys = page.keys();
        const [turn, tilt] = [Number(keys.get('turn')), Number(keys.get('tilt'))];
        // All of the width is all the way round.
        expect(turn).toBeCloseTo((60 / kWidth) * 360, 3);
        expect(tilt).toBeCloseTo((20 / kWidth) * 360, 3);
        expect(keys.has('eye')).toBe(false);
        await expectPicture(render(`block.prt.glb --light sun.json --rotate ${tilt},${turn},0`));
    });

    it('orbits by a drag, and leaves the light', async () => {
        await page.show(`${kPlain}&light=1`);
        await drag(80, 30);
        await page.waitForAddress();
        const keys = page.keys();
        expect(keys.has('turn')).toBe(false);
        await expectPicture(render(`block.prt.glb --light sun.json --eye ${keys.get('eye')} --target ${keys.get('target')} --fov ${await page.verticalFovDegrees()}`));
    });

    it('orbits by one finger and comes nearer by two', async () => {
        await page.show(kPlain);
        await page.touch([[[200, 130]], [[230, 135]], [[260, 140]]]);
        await page.waitForAddress();
        const [before, target] = [page.point('eye'), page.point('target')];
        await page.touch([[[220, 130], [260, 130]], [[200, 130], [280, 130]], [[180, 130], [300, 130]]]);
        await page.waitForAddress();
        expect(distance(page.point('eye'), target)).toBeLessThan(0.8 * distance(before, target));
        expect(page.opened.complaints).toEqual([]);
    });

    it('has controls for what the address tells', async () => {
        const browser = page.opened.page;
        await browser.setViewportSize({ width: 1000, height: 800 });
        await page.open(`${folder.url('page.html')}#exposure=0`);
        const track = (await browser.locator('input[name=turn]').boundingBox())!;
        await browser.mouse.move(track.x + track.width / 2, track.y + track.height / 2);
        await browser.mouse.down();
        await browser.mouse.move(track.x + 0.75 * track.width, track.y + track.height / 2, { steps: 3 });
        await browser.mouse.up();
        await browser.locator('input[name=bands]').fill('2');
        await browser.locator('select[name=transport]').selectOption('shadowed');
        await browser.locator('select[name=window]').selectOption('hann');
        await browser.locator('select[name=tone]').selectOption('neutral');
        await browser.locator('input[name=background]').uncheck();
        await browser.locator('input[name=split]').check();
        await browser.locator('select[name="other.asset"]').selectOption('2');
        await page.waitForAddress();
        const { turn, ...others } = Object.fromEntries(page.keys());
        // The thumb takes some of the track's length.
        expect(Math.abs(Number(turn) - 90)).toBeLessThan(15);
        const expected = { bands: '2', transport: 'shadowed', window: 'hann', tone: 'neutral', background: '0', split: '0.5', 'other.asset': '2', exposure: '0' };
        expect(others).toEqual(expected);
        await browser.setViewportSize({ width: kWidth, height: kHeight });
        await page.show(`ui=0&background=0&exposure=0&tone=neutral&bands=2&transport=shadowed&window=hann&turn=${turn}`);
        await expectPicture(render(`block.prt.glb --light sky-2.json --transport shadowed --window hann --tone neutral --rotate 0,${turn},0`));
    });

    it('moves the line that splits the picture', async () => {
        await page.show(`${kPlain.replace('ui=0&', '')}&split=0.5`);
        const { mouse } = page.opened.page;
        await mouse.move(kWidth / 2, kHeight / 3);
        await mouse.down();
        await mouse.move(kWidth / 4, kHeight / 3, { steps: 3 });
        await mouse.up();
        await page.waitForAddress();
        expect(Number(page.keys().get('split'))).toBeCloseTo(0.25, 2);
        expect(page.keys().has('eye')).toBe(false);
    });

    it('sums radiance on the GPU where it is asked to', async () => {
        await page.open(`${folder.url('page.html')}?mode=gpu#${kPlain}`);
        await expectPicture(render('block.prt.glb --light sky.json'));
        await page.show(`${kPlain}&asset=1&turn=20`);
        await expectPicture(render('clusters.prt.glb --light sky.json --rotate 0,20,0'));
    });

    it('shows the same after a lost context', async () => {
        await page.show(`${kPlain}&turn=10`);
        const before = await page.picture();
        const frame = await page.frameCount();
        await page.opened.page.evaluate(async () => {
            const lost = document.querySelector('canvas')!.getContext('webgl2')!.getExtension('WEBGL_lose_context')!;
            lost.loseContext();
            await new Promise((resolve) => setTimeout(resolve, 100));
            lost.restoreContext();
        });
        await page.settle(frame);
        expect(compare(await page.picture(), before).whole).toBeGreaterThan(100);
        const said = page.opened.complaints.splice(0);
        expect(said.filter((complaint) => !/context (was )?lost|context (was )?restored|CONTEXT_LOST/i.test(complaint))).toEqual([]);
        expect(await page.message()).toBe('');
    });

    const kHostile = [
        'asset=99999999&light=-1&bands=1e9&split=-5&exposure=1e9&turn=NaN',
        'eye=1e308,1e308,1e308&target=-1e308,0,0',
        'eye=0,0,0&target=0,0,0',
        'eye=1,2&target=,,&turn=Infinity&tilt=1e400',
        'other.asset=-1&split=0.5&other.bands=0&other.transport=constructor&transport=__proto__',
        '__proto__=1&constructor=2&toString=3&__proto__.ui=0',
        '%&%00&%E0%A4%A&=&&==&asset=%00',
        'tone=<img src=x onerror=window.harm=1>&transport="><script>window.harm=1</script>',
        'light=javascript:window.harm=1&window=constructor',
        'x'.repeat(100000),
    ];

    it('comes to no harm by what stands in its address', async () => {
        for (const hash of kHostile) await page.show(hash);
        for (const hash of [kHostile[0], kHostile.join('&')]) {
            await page.open(`${folder.url('page.html')}#${hash}`);
            expect(await page.state()).toBe('ready');
            expect(page.opened.complaints).toEqual([]);
        }
        expect(await page.opened.page.evaluate(() => (window as unknown as { harm?: number }).harm)).toBeUndefined();
        await page.show(kPlain);
        await expectPicture(render('block.prt.glb --light sky.json'));
    });

    it('measures itself', async () => {
        await page.opened.page.goto(`${folder.url('page.html')}?benchmark`);
        const result: any = JSON.parse((await page.opened.page.getAttribute('#benchmark', 'data-result', { timeout: 90000 }))!);
        expect(result.renderer).toMatch(/./);
        expect(result.vertexCount).toBeGreaterThan(100);
        for (const milliseconds of [result.firstPictureMs, result.loadMs, result.orbit.medianMs, result.turn.p95Ms, result.orbit.fps, result.turn.fps]) {
            expect(milliseconds).toBeGreaterThan(0);
            expect(milliseconds).toBeLessThan(Infinity);
        }
        expect(result.orbit.p95Ms).toBeGreaterThanOrEqual(result.orbit.medianMs);
        expect(page.opened.complaints).toEqual([]);
    });
});

type Point = readonly number[];
const distance = (a: Point, b: Point): number => Math.hypot(...a.map((value, i) => value - b[i]));
