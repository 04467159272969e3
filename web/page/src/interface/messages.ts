/** The one sentence that the page says to its user. */
export class Messages {
    constructor(
        private readonly box: HTMLElement,
        private readonly text: HTMLElement,
        dismiss: HTMLElement,
    ) {
        dismiss.addEventListener('click', () => this.clear());
    }

    say(sentence: string): void {
        this.text.textContent = sentence;
        this.box.hidden = false;
    }

    /** @param sentence  only if it is this one that is said */
    clear(sentence = this.text.textContent): void {
        if (this.text.textContent !== sentence) return;
        this.text.textContent = '';
        this.box.hidden = true;
    }
}

/** What an error says, as a sentence about something. */
export function sentenceOf(what: string, error: unknown): string {
    const words = error instanceof Error ? error.message : String(error);
    return `${what} cannot be shown: ${words}${/[.!?]$/.test(words) ? '' : '.'}`;
}
