import { AssetShelf } from './assets/asset_shelf.js';
import type { LoadedAsset, Mode } from './assets/load_asset.js';
import { type Messages, sentenceOf } from './interface/messages.js';
import { type Light, rotationOf } from './lights/lights.js';
import type { PageData } from './page_data.js';
import { type Covered, OrbitCamera } from './picture/camera.js';
import { Picture } from './picture/picture.js';
import { type Side, type SideName, type ViewState, kDefaultState, sideOf } from './view_state.js';

/** How far the page is, for whoever drives it: data-state of the document's element, and data-frame, which counts the frames. */
type Progress = 'loading' | 'ready' | 'failed';

// Between the frames of a movement pass fewer.
const kRestMilliseconds = 200;

/** Shows what the state says, and draws only when that has changed. */
export class Viewer {
    state: ViewState = { ...kDefaultState };
    /** Asked before each frame. */
    measureCovered = (): Covered => ({ right: 0, bottom: 0 });
    readonly picture: Picture;
    readonly shelf: AssetShelf;
    readonly camera: OrbitCamera;
    private readonly broken = new Set<number>();
    private readonly listeners: (() => void)[] = [];
    private readonly waiting: ((beginMilliseconds: number) => void)[] = [];
    private lastShown: number | undefined;
    private lookedAt: LoadedAsset | undefined;
    private frameRequest = 0;
    private frameCount = 0;
    private isLost = false;
    private restTimer = 0;
    private isAtRest = false;

    constructor(
        canvas: HTMLCanvasElement,
        gl: WebGL2RenderingContext,
        { assets }: PageData,
        readonly lights: Light[],
        readonly mode: Mode,
        private readonly messages: Messages,
    ) {
        this.picture = new Picture(canvas, gl);
        this.shelf = new AssetShelf(assets, mode);
        this.camera = new OrbitCamera(canvas, (eye, target) => this.change({ eye, target }));
        new ResizeObserver(() => this.refresh()).observe(canvas);
        this.watchContext(canvas);
    }

    /** Tells of every frame that was drawn. */
    onFrame(listener: () => void): void {
        this.listeners.push(listener);
    }

    /** Waits for a frame. @returns  when it was begun, as performance.now() tells */
    nextFrame(): Promise<number> {
        return new Promise((resolve) => this.waiting.push(resolve));
    }

    change(change: Partial<ViewState>): void {
        this.state = { ...this.state, ...change };
        this.refresh();
    }

    /** Another asset is then seen from where it wants to be seen. */
    changeSide(name: SideName, change: Side): void {
        const isOther = name === 'first' && change.asset !== undefined && change.asset !== this.assetIndexOf('first');
        this.change({ [name]: { ...this.state[name], ...change }, ...(isOther ? { eye: undefined, target: undefined } : {}) });
    }

    /** Shows the asset from where it wants to be seen. */
    resetCamera(): void {
        this.lookedAt = undefined;
        this.change({ eye: undefined, target: undefined });
    }

    /** Takes the whole state from elsewhere. */
    replace(state: ViewState): void {
        this.lookedAt = undefined;
        this.change({ eye: undefined, target: undefined, exposureStops: undefined, split: undefined, ...state });
    }

    /** What a half shows, with an index that there is. */
    assetIndexOf(name: SideName): number {
        const index = sideOf(this.state, name).asset ?? 0;
        return index < this.shelf.names.length && !this.broken.has(index) ? index : this.fallback();
    }

    /** Of the light that is shown. */
    get lightIndex(): number {
        return this.state.light < this.lights.length ? this.state.light : 0;
    }

    get light(): Light {
        return this.lights[this.lightIndex];
    }

    get exposureStops(): number {
        return this.state.exposureStops ?? this.light.exposureStops;
    }

    get progress(): Progress {
        return document.documentElement.dataset.state as Progress;
    }

    /** Draws soon, once what is to be seen is there. */
    refresh(): void {
        if (this.progress !== 'failed') this.tell('loading');
        this.isAtRest = false;
        if (this.frameRequest === 0) this.frameRequest = requestAnimationFrame(() => this.update());
    }

    private update(): void {
        this.frameRequest = 0;
        if (this.isLost) return;
        if (this.shelf.names.length === 0) return this.draw([]);
        const names: SideName[] = this.state.split === undefined ? ['first'] : ['first', 'other'];
        const indices = names.map((name) => this.assetIndexOf(name));
        const missing = indices.find((index) => index >= 0 && !this.shelf.find(index));
        if (indices.includes(-1)) this.tell('failed');
        else if (missing !== undefined) void this.load(missing);
        else this.draw(indices);
    }

    private async load(index: number): Promise<void> {
        try {
            await this.shelf.load(index);
        } catch (error) {
            this.broken.add(index);
            this.messages.say(sentenceOf(this.shelf.names[index], error));
        }
        this.refresh();
    }

    /** Draws now. @param indices  of one or two assets, which are loaded, or of none */
    private draw(indices: readonly number[]): void {
        const { picture, light, state } = this;
        const begin = performance.now();
        const [first, other] = indices.map((index) => this.shelf.find(index));
        const rotation = rotationOf(state);
        if (first) picture.first.show(first);
        let isWhole = picture.first.relight(sideOf(state, 'first'), light, rotation, !this.isAtRest);
        if (other) {
            picture.other.show(other);
            isWhole = picture.other.relight(sideOf(state, 'other'), light, rotation, !this.isAtRest) && isWhole;
        } else {
            picture.other.clear();
        }
        this.shelf.keepOnly(indices);
        if (first) this.lookAt(first, indices[0]);
        const isCoarse = picture.isSlow && !this.isAtRest;
        const { exposureStops } = this;
        const covered = this.measureCovered();
        const { tone, background, split } = state;
        picture.draw({ light, rotation, exposureStops, tone, background, split, covered, isCoarse }, this.camera);
        document.documentElement.dataset.frame = String(++this.frameCount);
        if (isWhole && !isCoarse) this.tell('ready');
        else this.drawWholeSoon();
        for (const listener of this.listeners) listener();
        for (const resolve of this.waiting.splice(0)) resolve(begin);
    }

    /** Draws all of it once nothing moves. */
    private drawWholeSoon(): void {
        clearTimeout(this.restTimer);
        this.restTimer = window.setTimeout(() => {
            this.isAtRest = true;
            if (this.frameRequest === 0) this.frameRequest = requestAnimationFrame(() => this.update());
        }, kRestMilliseconds);
    }

    private lookAt(asset: LoadedAsset, index: number): void {
        if (asset === this.lookedAt) return;
        this.camera.look(asset, this.state);
        this.lookedAt = asset;
        this.lastShown = index;
    }

    /** The asset that is shown instead of one that cannot be; −1: none. */
    private fallback(): number {
        const indices = [this.lastShown ?? 0, ...this.shelf.names.keys()];
        return indices.find((index) => index < this.shelf.names.length && !this.broken.has(index)) ?? -1;
    }

    private tell(progress: Progress): void {
        document.documentElement.dataset.state = progress;
    }

    private watchContext(canvas: HTMLCanvasElement): void {
        const kLost = 'The browser has taken the graphics away, and the picture comes back when it gives them back.';
        canvas.addEventListener('webglcontextlost', () => {
            this.isLost = true;
            this.tell('loading');
            this.messages.say(kLost);
        });
        canvas.addEventListener('webglcontextrestored', () => {
            this.isLost = false;
            this.messages.clear(kLost);
            this.refresh();
        });
    }
}
