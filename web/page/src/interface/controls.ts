/** A control of the panel: what stands there, and how it comes to show what is the case. */
export interface Control {
    element: HTMLElement;
    refresh(): void;
}

type Child = HTMLElement | string;

/** An element with properties and children. */
export function make<Tag extends keyof HTMLElementTagNameMap>(
    tag: Tag, properties: Partial<HTMLElementTagNameMap[Tag]> = {}, ...children: Child[]
): HTMLElementTagNameMap[Tag] {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
}

/** @param name  of the key of the address that the control changes */
export function makeSlider(
    name: string, label: string, limits: { least: number; most: number; step: number },
    get: () => number, set: (value: number) => void, format: (value: number) => string,
): Control & { input: HTMLInputElement } {
    const input = make('input', { type: 'range', name, min: String(limits.least), max: String(limits.most), step: String(limits.step) });
    const output = make('output');
    input.addEventListener('input', () => set(input.valueAsNumber));
    return {
        element: make('label', { className: 'row' }, make('span', {}, label), input, output),
        input,
        refresh: () => {
            if (input.valueAsNumber !== get()) input.value = String(get());
            output.textContent = format(get());
        },
    };
}

export interface Choice {
    value: string;
    label: string;
}

export function makeSelect(name: string, label: string, choices: () => Choice[], get: () => string, set: (value: string) => void): Control {
    const select = make('select', { name });
    select.addEventListener('change', () => set(select.value));
    let shown = '';
    return {
        element: make('label', { className: 'row' }, make('span', {}, label), select),
        refresh: () => {
            const wanted = choices();
            if (shown !== JSON.stringify(wanted)) {
                shown = JSON.stringify(wanted);
                select.replaceChildren(...wanted.map(({ value, label: text }) => make('option', { value }, text)));
            }
            select.value = get();
        },
    };
}

export function makeCheckbox(name: string, label: string, get: () => boolean, set: (value: boolean) => void): Control {
    const input = make('input', { type: 'checkbox', name });
    input.addEventListener('change', () => set(input.checked));
    return { element: make('label', { className: 'check' }, input, make('span', {}, label)), refresh: () => void (input.checked = get()) };
}

/** A few choices side by side, of which one is pressed. */
export function makeSegments(name: string, label: string, choices: readonly Choice[], get: () => string, set: (value: string) => void): Control {
    const buttons = choices.map(({ value, label: text }) => {
        const button = make('button', { type: 'button', name, value }, text);
        button.addEventListener('click', () => set(value));
        return button;
    });
    const group = make('div', { className: 'segments', role: 'group', ariaLabel: label }, ...buttons);
    return {
        element: make('div', { className: 'row' }, make('span', {}, label), group),
        refresh: () => buttons.forEach((button) => (button.ariaPressed = String(button.value === get()))),
    };
}

export function makeButton(label: string, onClick: () => void): HTMLButtonElement {
    const button = make('button', { type: 'button', className: 'action' }, label);
    button.addEventListener('click', onClick);
    return button;
}
