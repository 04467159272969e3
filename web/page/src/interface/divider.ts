import type { Viewer } from '../viewer.js';
import { make } from './controls.js';

const kStep = 0.02;

/** The line between the two halves, to be dragged or moved by the arrow keys. */
export class Divider {
    private readonly line = make('div', { id: 'divider', role: 'separator', tabIndex: 0, ariaLabel: 'Where the picture is split' });

    constructor(private readonly canvas: HTMLCanvasElement, private readonly viewer: Viewer) {
        this.line.addEventListener('pointerdown', (event) => this.line.setPointerCapture(event.pointerId));
        this.line.addEventListener('pointermove', (event) => {
            if (this.line.hasPointerCapture(event.pointerId)) this.move(event.clientX / this.canvas.clientWidth);
        });
        this.line.addEventListener('keydown', ({ key }) => {
            const { split = 0.5 } = this.viewer.state;
            if (key === 'ArrowLeft') this.move(split - kStep);
            if (key === 'ArrowRight') this.move(split + kStep);
        });
        document.body.append(this.line);
        viewer.onFrame(() => this.refresh());
        this.refresh();
    }

    private move(split: number): void {
        this.viewer.change({ split: Math.min(Math.max(split, 0), 1) });
    }

    private refresh(): void {
        const { split } = this.viewer.state;
        this.line.hidden = split === undefined;
        this.line.style.left = `${100 * (split ?? 0)}%`;
        this.line.ariaValueNow = String(Math.round(100 * (split ?? 0)));
    }
}
