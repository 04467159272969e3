import { kTransports } from 'openprt-three';

import type { Covered } from '../picture/camera.js';
import { chooseShown } from '../picture/pane.js';
import { type ToneCurve } from '../picture/tone_curve.js';
import { type SideName, type WindowName, sideOf } from '../view_state.js';
import type { Viewer } from '../viewer.js';
import { type Choice, type Control, make, makeButton, makeCheckbox, makeSegments, makeSelect, makeSlider } from './controls.js';
import { describeAsset } from './facts.js';
import type { DragTarget, LightGesture } from './gestures.js';
import { makeThumbnails } from './thumbnails.js';

const kTransportLabels: Record<(typeof kTransports)[number], string> = {
    unshadowed: 'No shadows',
    shadowed: 'Shadows',
    interreflected: 'Shadows, bounces',
    'glossy-shadowed': 'Glossy, shadows',
    glossy: 'Glossy, bounces',
};

const kWindowLabels: Record<WindowName, string> = { auto: 'As needed', none: 'None', hann: 'Hann', lanczos: 'Lanczos' };
const kToneLabels: Record<ToneCurve, string> = { aces: 'Filmic (ACES)', neutral: 'Neutral', none: 'None' };

function choicesOf<Value extends string>(labels: Record<Value, string>): Choice[] {
    return Object.entries<string>(labels).map(([value, label]) => ({ value, label }));
}

function formatDegrees(degrees: number): string {
    return `${Math.round(degrees)}°`;
}

function formatStops(stops: number): string {
    return `${stops < 0 ? '−' : '+'}${Math.abs(stops).toFixed(1)}`;
}

/** Screens on which the panel is a sheet at the bottom, as page.css has it. */
const kNarrow = matchMedia('(max-width: 640px)');

/** What stands beside the picture: every part of the state, to be seen and changed. */
export class Panel {
    private readonly controls: Control[] = [];
    private readonly facts = make('p', { className: 'facts' });
    private readonly title = make('h1');
    private readonly panel: HTMLElement;
    /** What there is to choose of assets only. */
    private readonly ofAssets: HTMLElement[];
    /** At the last frame. */
    private covered: Covered = { right: 0, bottom: 0 };

    /** @param openFiles  asks for files to show */
    constructor(private readonly viewer: Viewer, gesture: LightGesture, openFiles: () => void) {
        this.ofAssets = [this.makeSurface(), this.makeCompare()];
        const [surface, compare] = this.ofAssets;
        const body = make('div', { className: 'body', id: 'panel-body' }, this.makeLight(gesture), surface, this.makePicture(), compare);
        body.append(make('div', { className: 'actions' }, makeButton('Open files…', openFiles), makeButton('Reset view', () => viewer.resetCamera())));
        const fold = make('button', { type: 'button', id: 'panel-fold', ariaLabel: 'Show or hide the controls' });
        fold.setAttribute('aria-controls', body.id);
        fold.addEventListener('click', () => this.fold(fold, !this.panel.classList.contains('folded')));
        this.panel = make('aside', { id: 'panel' }, make('header', {}, make('div', {}, this.title, this.facts), fold), body);
        this.fold(fold, kNarrow.matches);
        document.body.append(this.panel);
        viewer.measureCovered = () => (this.covered = this.measure());
        new ResizeObserver(() => {
            const { right, bottom } = this.measure();
            if (right !== this.covered.right || bottom !== this.covered.bottom) viewer.refresh();
        }).observe(this.panel);
        viewer.onFrame(() => this.refresh());
    }

    refresh(): void {
        const { viewer } = this;
        const index = viewer.assetIndexOf('first');
        this.title.textContent = viewer.shelf.names[index] ?? 'OpenPRT';
        const asset = viewer.shelf.find(index);
        this.facts.textContent = asset ? describeAsset(asset.relightable, sideOf(viewer.state, 'first')) : '';
        for (const section of this.ofAssets) section.hidden = viewer.shelf.names.length === 0;
        for (const control of this.controls) control.refresh();
    }

    private fold(button: HTMLButtonElement, isFolded: boolean): void {
        this.panel.classList.toggle('folded', isFolded);
        button.ariaExpanded = String(!isFolded);
    }

    /** What the panel covers: as a sheet the bottom, as a column the right, and with its head alone nothing. */
    private measure(): Covered {
        document.body.classList.toggle('bare', !this.viewer.state.ui);
        const { left, top, width } = this.panel.getBoundingClientRect();
        if (width === 0) return { right: 0, bottom: 0 };
        if (kNarrow.matches) return { right: 0, bottom: innerHeight - top };
        return { right: this.panel.classList.contains('folded') ? 0 : innerWidth - left, bottom: 0 };
    }

    private add<Kind extends Control>(control: Kind): Kind {
        this.controls.push(control);
        return control;
    }

    private makeLight(gesture: LightGesture): HTMLElement {
        const { viewer } = this;
        const degrees = { least: -180, most: 180, step: 1 };
        const drag = makeSegments(
            'drag', 'Drag turns', [{ value: 'camera', label: 'Camera' }, { value: 'light', label: 'Light' }],
            () => gesture.target,
            (value) => {
                gesture.target = value as DragTarget;
                drag.refresh();
            },
        );
        return this.section(
            'Light',
            makeThumbnails(viewer.lights, () => viewer.lightIndex, (light) => viewer.change({ light })),
            makeSlider('turn', 'Turn', degrees, () => viewer.state.turnDegrees, (turnDegrees) => viewer.change({ turnDegrees }), formatDegrees),
            makeSlider('tilt', 'Tilt', degrees, () => viewer.state.tiltDegrees, (tiltDegrees) => viewer.change({ tiltDegrees }), formatDegrees),
            drag,
        );
    }

    private makeSurface(): HTMLElement {
        return this.section('Surface', ...this.makeSide('first'));
    }

    private makePicture(): HTMLElement {
        const { viewer } = this;
        const stops = makeSlider(
            'exposure', 'Exposure', { least: -20, most: 20, step: 0.1 },
            () => viewer.exposureStops, (exposureStops) => viewer.change({ exposureStops }), formatStops,
        );
        return this.section(
            'Picture',
            stops,
            makeCheckbox(
                'auto', 'Exposure follows the light', () => viewer.state.exposureStops === undefined,
                (isAuto) => viewer.change({ exposureStops: isAuto ? undefined : Number(viewer.exposureStops.toFixed(1)) }),
            ),
            makeSelect('tone', 'Tone curve', () => choicesOf(kToneLabels), () => viewer.state.tone, (tone) => viewer.change({ tone: tone as ToneCurve })),
            makeCheckbox('background', 'Light as background', () => viewer.state.background, (background) => viewer.change({ background })),
        );
    }

    private makeCompare(): HTMLElement {
        const { viewer } = this;
        const isSplit = (): boolean => viewer.state.split !== undefined;
        const side = make('div', { className: 'side' }, ...this.makeSide('other').map((control) => this.add(control).element));
        const toggle = makeCheckbox('split', 'Split the picture', isSplit, (split) => viewer.change({ split: split ? 0.5 : undefined }));
        return this.section('Compare', toggle, { element: side, refresh: () => void (side.hidden = !isSplit()) });
    }

    /** What a half shows. */
    private makeSide(name: SideName): Control[] {
        const { viewer } = this;
        const prefix = name === 'first' ? '' : 'other.';
        const relightable = () => viewer.shelf.find(viewer.assetIndexOf(name))?.relightable;
        const shown = () => {
            const found = relightable();
            return found && chooseShown(found, sideOf(viewer.state, name));
        };
        const assets = makeSelect(
            `${prefix}asset`, 'Asset', () => viewer.shelf.names.map((label, i) => ({ value: String(i), label })),
            () => String(viewer.assetIndexOf(name)), (index) => viewer.changeSide(name, { asset: Number(index) }),
        );
        const bands = makeSlider(
            `${prefix}bands`, 'Bands', { least: 1, most: 10, step: 1 },
            () => shown()?.bands ?? 1, (count) => viewer.changeSide(name, { bands: count }), String,
        );
        return [
            {
                element: assets.element,
                refresh: () => {
                    assets.element.hidden = viewer.shelf.names.length < 2;
                    assets.refresh();
                },
            },
            makeSelect(
                `${prefix}transport`, 'Transport',
                () => (relightable()?.transports ?? []).map((value) => ({ value, label: kTransportLabels[value] })),
                () => shown()?.transport ?? '',
                (value) => viewer.changeSide(name, { transport: kTransports.find((transport) => transport === value) }),
            ),
            {
                element: bands.element,
                refresh: () => {
                    bands.input.max = String(relightable()?.bandCount ?? 10);
                    bands.refresh();
                },
            },
            makeSelect(
                `${prefix}window`, 'Smoothing', () => choicesOf(kWindowLabels),
                () => shown()?.window ?? 'auto', (window) => viewer.changeSide(name, { window: window as WindowName }),
            ),
        ];
    }

    private section(title: string, ...controls: Control[]): HTMLElement {
        return make('section', {}, make('h2', {}, title), ...controls.map((control) => this.add(control).element));
    }
}
