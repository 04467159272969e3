import { MOUSE, TOUCH } from 'three';

import { wrapDegrees } from '../view_state.js';
import type { Viewer } from '../viewer.js';

/** How far the light turns while the pointer goes across the whole canvas; it keeps up with the side of the asset that faces the eye. */
const kDegreesPerWidth = 360;

const kDegreesPerKey = 5;
const kZoomPerKey = 0.9;
const kArrows: Record<string, [right: number, down: number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** What a drag of one finger or the left button turns. */
export type DragTarget = 'camera' | 'light';

/** Turns the light where the camera's controls would turn the camera: on demand, or while Shift or Ctrl is held. */
export class LightGesture {
    target: DragTarget = 'camera';
    private readonly pointers = new Map<number, PointerEvent>();
    private isTurning = false;

    constructor(private readonly canvas: HTMLCanvasElement, private readonly viewer: Viewer) {
        // Before the camera's controls hear of it.
        canvas.addEventListener('pointerdown', (event) => this.begin(event), { capture: true });
        canvas.addEventListener('pointermove', (event) => this.move(event));
        canvas.addEventListener('keydown', (event) => this.press(event));
        for (const end of ['pointerup', 'pointercancel'] as const) canvas.addEventListener(end, (event) => this.end(event));
    }

    /** Arrows turn the camera, with Shift the light; plus and minus go nearer and away. */
    private press(event: KeyboardEvent): void {
        const { viewer } = this;
        const { controls } = viewer.camera;
        const [right, down] = kArrows[event.key] ?? [0, 0];
        if (event.key === '+' || event.key === '=') controls.dollyIn(kZoomPerKey);
        else if (event.key === '-') controls.dollyOut(kZoomPerKey);
        else if (right === 0 && down === 0) return;
        else if (event.shiftKey || this.target === 'light') this.turnLight(kDegreesPerKey * right, kDegreesPerKey * down);
        else {
            controls.rotateLeft((kDegreesPerKey * right * Math.PI) / 180);
            controls.rotateUp((kDegreesPerKey * down * Math.PI) / 180);
        }
        event.preventDefault();
    }

    private turnLight(turn: number, tilt: number): void {
        const { turnDegrees, tiltDegrees } = this.viewer.state;
        this.viewer.change({ turnDegrees: wrapDegrees(turnDegrees + turn), tiltDegrees: wrapDegrees(tiltDegrees + tilt) });
    }

    private begin(event: PointerEvent): void {
        this.pointers.set(event.pointerId, event);
        const isLeft = event.pointerType === 'touch' || event.button === 0;
        const isLight = this.target === 'light' || event.shiftKey || event.ctrlKey || event.metaKey;
        const { controls } = this.viewer.camera;
        controls.mouseButtons.LEFT = isLight ? null : MOUSE.ROTATE;
        controls.touches.ONE = isLight ? null : TOUCH.ROTATE;
        this.isTurning = isLeft && isLight && this.pointers.size === 1;
    }

    private move(event: PointerEvent): void {
        const before = this.pointers.get(event.pointerId);
        if (!before) return;
        this.pointers.set(event.pointerId, event);
        if (!this.isTurning) return;
        const degreesPerPixel = kDegreesPerWidth / this.canvas.clientWidth;
        this.turnLight(degreesPerPixel * (event.clientX - before.clientX), degreesPerPixel * (event.clientY - before.clientY));
    }

    private end(event: PointerEvent): void {
        this.pointers.delete(event.pointerId);
        this.isTurning = false;
    }
}
