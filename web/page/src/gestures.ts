import { MOUSE, TOUCH } from 'three';

import { wrapDegrees } from './view_state.js';
import type { Viewer } from './viewer.js';

/** How far the light turns while the pointer goes across the whole canvas; it keeps up with the side of the asset that faces the eye. */
const kDegreesPerWidth = 360;

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
        for (const end of ['pointerup', 'pointercancel'] as const) canvas.addEventListener(end, (event) => this.end(event));
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
        const { turnDegrees, tiltDegrees } = this.viewer.state;
        this.viewer.change({
            turnDegrees: wrapDegrees(turnDegrees + degreesPerPixel * (event.clientX - before.clientX)),
            tiltDegrees: wrapDegrees(tiltDegrees + degreesPerPixel * (event.clientY - before.clientY)),
        });
    }

    private end(event: PointerEvent): void {
        this.pointers.delete(event.pointerId);
        this.isTurning = false;
    }
}
