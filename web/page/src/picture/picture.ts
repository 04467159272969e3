import type { Mat3 } from 'openprt-three';
import { WebGLRenderer } from 'three';

import type { Light } from '../lights/lights.js';
import { Background } from './background.js';
import type { Covered, OrbitCamera } from './camera.js';
import { Pane } from './pane.js';
import { type ToneCurve, kToneMappings } from './tone_curve.js';

const kMostPixelRatio = 2;
const kCoarsePixelRatio = 0.5;
/** Without multisampling four pixels stand for one at least. */
const kSupersampledPixelRatio = 2;

/** How the panes become a picture. */
export interface Shot {
    light: Light;
    rotation: Mat3;
    exposureStops: number;
    tone: ToneCurve;
    background: boolean;
    /** Where the second pane begins, 0 to 1 of the width; absent: nowhere. */
    split?: number | undefined;
    /** What is looked at stands in the middle of the rest. */
    covered: Covered;
    /** Of fewer pixels, while things move and the CPU draws. */
    isCoarse: boolean;
}

/** The canvas: two panes, side by side where it is split, and the light behind them. */
export class Picture {
    readonly first = new Pane(false);
    readonly other = new Pane(true);
    private readonly background = new Background();
    private readonly renderer: WebGLRenderer;
    /** Whether pixels are so dear that there had better be fewer while things move. */
    readonly isSlow: boolean;

    constructor(
        private readonly canvas: HTMLCanvasElement,
        private readonly gl: WebGL2RenderingContext,
    ) {
        this.renderer = new WebGLRenderer({ canvas, context: gl });
        this.isSlow = !gl.getContextAttributes()?.antialias;
        this.renderer.autoClear = false;
        this.renderer.setClearColor(0x000000, 1);
    }

    draw(shot: Shot, orbit: OrbitCamera): void {
        const { renderer, canvas } = this;
        const [width, height] = [canvas.clientWidth, canvas.clientHeight];
        if (width === 0 || height === 0) return;
        const fineRatio = this.isSlow ? kSupersampledPixelRatio : Math.min(devicePixelRatio, kMostPixelRatio);
        const ratio = shot.isCoarse ? kCoarsePixelRatio : fineRatio;
        if (canvas.width !== Math.floor(width * ratio) || canvas.height !== Math.floor(height * ratio)) {
            renderer.setPixelRatio(ratio);
            renderer.setSize(width, height, false);
        }
        orbit.fit(width, height, shot.covered);
        renderer.toneMapping = kToneMappings[shot.tone];
        renderer.toneMappingExposure = 2 ** shot.exposureStops;
        if (shot.background) {
            this.background.set(shot.light.picture, shot.rotation);
            this.background.look(orbit.camera);
        }
        renderer.setScissorTest(false);
        renderer.clear();
        if (shot.background) renderer.render(this.background.scene, orbit.camera);
        if (shot.split === undefined) {
            renderer.render(this.first.scene, orbit.camera);
            return;
        }
        const middle = Math.round(shot.split * width);
        renderer.setScissorTest(true);
        renderer.setScissor(0, 0, middle, height);
        renderer.render(this.first.scene, orbit.camera);
        renderer.setScissor(middle, 0, width - middle, height);
        renderer.render(this.other.scene, orbit.camera);
    }

    /** Waits until all that was asked of the GPU is done. */
    finish(): void {
        const { gl } = this;
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
}
