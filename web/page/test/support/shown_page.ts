import type { OpenPage } from '../../../support/chromium.js';
import { type Picture, readPng } from '../../../support/picture.js';

/** A page of prt web in the browser, driven by its address. */
export class ShownPage {
    constructor(readonly opened: OpenPage) {}

    /** Goes to a page, or loads it again, and waits for its picture or for what it says instead. */
    async open(url: string): Promise<void> {
        this.opened.complaints.length = 0;
        await this.opened.page.goto('about:blank');
        await this.opened.page.goto(url);
        await this.settle();
    }

    /** Changes what stands behind # in the address, and waits for the picture of it. */
    async show(hash: string): Promise<void> {
        const frame = await this.frameCount();
        const isNew = await this.opened.page.evaluate((text) => {
            const before = location.href;
            location.hash = text;
            return location.href !== before;
        }, hash);
        await this.settle(isNew ? frame : -1);
    }

    /** Waits until the picture is that of the state, and later than a frame; or until the page has failed. */
    async settle(frame = -1): Promise<void> {
        await this.opened.page.waitForFunction(
            (last) => {
                const { state, frame: count = '0' } = document.documentElement.dataset;
                return state === 'failed' || (state === 'ready' && Number(count) > last);
            },
            frame,
            { timeout: 20000 },
        );
    }

    /** Waits until the address tells what is shown, as it does soon after a gesture. */
    async waitForAddress(): Promise<void> {
        for (let before = ''; before !== this.opened.page.url(); ) {
            before = this.opened.page.url();
            await this.opened.page.waitForTimeout(500);
        }
        await this.settle();
    }

    keys(): URLSearchParams {
        return new URLSearchParams(new URL(this.opened.page.url()).hash.slice(1));
    }

    /** A point of the address. */
    point(key: string): number[] {
        return this.keys().get(key)!.split(',').map(Number);
    }

    /** Puts fingers down, moves them from place to place, and takes them away. @param places  x, y of each finger */
    async touch(places: readonly (readonly [number, number])[][]): Promise<void> {
        const session = await this.opened.page.context().newCDPSession(this.opened.page);
        await session.send('Emulation.setTouchEmulationEnabled', { enabled: true });
        for (const [i, fingers] of places.entries()) {
            const touchPoints = fingers.map(([x, y], id) => ({ x, y, id }));
            await session.send('Input.dispatchTouchEvent', { type: i === 0 ? 'touchStart' : 'touchMove', touchPoints });
        }
        await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
        await session.send('Emulation.setTouchEmulationEnabled', { enabled: false });
        await session.detach();
    }

    /** Of the first asset's camera. */
    verticalFovDegrees(): Promise<number> {
        return this.opened.page.evaluate(() => JSON.parse(document.getElementById('prt-data')!.textContent!).assets[0].camera.verticalFovDegrees);
    }

    frameCount(): Promise<number> {
        return this.opened.page.evaluate(() => Number(document.documentElement.dataset.frame ?? 0));
    }

    state(): Promise<string | undefined> {
        return this.opened.page.evaluate(() => document.documentElement.dataset.state);
    }

    async message(): Promise<string> {
        return (await this.opened.page.textContent('#message'))!.trim();
    }

    async picture(): Promise<Picture> {
        return readPng(await this.opened.page.screenshot());
    }
}
