import { radianceOf } from '../lights/light_picture.js';
import type { Light } from '../lights/lights.js';
import { applyToneCurve, encodeSrgb8 } from '../picture/tone_curve.js';
import { type Control, make } from './controls.js';

/** A light's picture, exposed for itself. */
function paint(canvas: HTMLCanvasElement, { picture, exposureStops }: Light): void {
    const { width, height } = picture;
    Object.assign(canvas, { width, height });
    const pixels = new ImageData(width, height);
    const gain = 2 ** exposureStops;
    for (let row = 0; row < height; ++row)
        for (let column = 0; column < width; ++column) {
            const [red, green, blue] = radianceOf(picture, column, row);
            const shown = applyToneCurve('aces', [gain * red, gain * green, gain * blue]);
            pixels.data.set([...shown.map(encodeSrgb8), 255], 4 * (row * width + column));
        }
    canvas.getContext('2d')!.putImageData(pixels, 0, 0);
}

/** A button for each light, with its picture on it. */
export function makeThumbnails(lights: readonly Light[], get: () => number, set: (index: number) => void): Control {
    const element = make('div', { className: 'thumbnails', role: 'group', ariaLabel: 'Light' });
    const buttons: HTMLButtonElement[] = [];
    const add = (light: Light): void => {
        const canvas = make('canvas');
        paint(canvas, light);
        const index = buttons.length;
        const button = make('button', { type: 'button', name: 'light', value: String(index), title: light.name }, canvas, make('span', {}, light.name));
        button.addEventListener('click', () => set(index));
        buttons.push(button);
        element.append(button);
    };
    return {
        element,
        refresh: () => {
            lights.slice(buttons.length).forEach(add);
            buttons.forEach((button, i) => (button.ariaPressed = String(i === get())));
        },
    };
}
