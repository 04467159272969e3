#pragma once

namespace prt::cli {

/// How a report looks: everything inline, so that the page needs no network.
inline constexpr const char* kReportStyle = R"(
:root { --ink: #1c2330; --soft: #5c6675; --line: #dfe3ea; --paper: #f5f6f8; --card: #fff; --accent: #1f6feb }
* { box-sizing: border-box }
body { font: 16px/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; color: var(--ink);
  background: var(--paper); margin: 0 auto; padding: 2rem 1.5rem 4rem; max-width: 1320px }
h1 { font-size: 1.7rem; margin: 0 0 .3rem } h2 { font-size: 1.3rem; margin: 2.6rem 0 .8rem }
h3 { font-size: 1.05rem; margin: 2rem 0 .6rem } p { margin: .4rem 0; max-width: 75ch }
code { font: .88em ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere }
.soft, figcaption, dd { color: var(--soft) }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(250px, 1fr)); gap: 1rem; margin: 1.2rem 0 }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 1rem 1.2rem }
.card b { display: block; font-size: 2rem; line-height: 1.2; font-weight: 650 }
.card span { font-weight: 600 } .card p { font-size: .9rem; color: var(--soft); margin: .3rem 0 0 }
.pictures { display: grid; grid-template-columns: repeat(3, 1fr); gap: 1rem }
.pictures.two { grid-template-columns: repeat(2, 1fr) }
figure { margin: 0 } img { width: 100%; display: block; border-radius: 6px }
figcaption { font-size: .9rem; margin-top: .35rem } figcaption b { color: var(--ink); font-weight: 600 }
.slider { position: relative; border-radius: 10px; overflow: hidden; --split: 50% }
.slider img { border-radius: 0 } .slider .over { position: absolute; inset: 0; clip-path: inset(0 calc(100% - var(--split)) 0 0) }
.slider i { position: absolute; top: 0; bottom: 0; left: var(--split); width: 2px; background: #fff;
  box-shadow: 0 0 4px #000; pointer-events: none }
.slider u { position: absolute; top: .6rem; padding: .1rem .6rem; border-radius: 1rem; font-size: .85rem;
  text-decoration: none; color: #fff; background: #000a; pointer-events: none }
.slider u:first-of-type { left: .6rem } .slider u:last-of-type { right: .6rem }
.slider input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; cursor: ew-resize }
.choice { display: flex; flex-wrap: wrap; gap: .4rem 1.4rem; margin: .6rem 0 }
table { border-collapse: collapse; background: var(--card); border: 1px solid var(--line); border-radius: 10px; width: 100% }
th, td { padding: .5rem .8rem; border-bottom: 1px solid var(--line); text-align: right; font-variant-numeric: tabular-nums }
th { font-weight: 600; font-size: .9rem } th:first-child, td:first-child { text-align: left }
tr:last-child td { border-bottom: 0 }
.scroll { overflow-x: auto } .matrix { table-layout: fixed; min-width: 1100px } .matrix img { border-radius: 3px }
.matrix td { padding: .35rem .2rem; text-align: center; font-size: .85rem } .matrix th { width: 9rem }
.matrix td:first-child { padding-left: .8rem; text-align: left }
.legend { display: flex; align-items: center; gap: .6rem; font-size: .85rem; color: var(--soft); margin: .5rem 0 }
.legend div { height: 12px; width: 220px; border-radius: 6px; border: 1px solid var(--line) }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .3rem 1.2rem; margin: .8rem 0; font-size: .93rem }
dt { font-weight: 600 } dd { margin: 0; max-width: 85ch }
@media (max-width: 800px) { .pictures, .pictures.two { grid-template-columns: 1fr } }
)";

/// Moves the sliders, and changes what lies under them.
inline constexpr const char* kReportScript = R"(
for (const slider of document.querySelectorAll('.slider'))
  slider.querySelector('input').oninput = event => slider.style.setProperty('--split', event.target.value + '%');
for (const radio of document.querySelectorAll('.choice input'))
  radio.onchange = () => { document.getElementById(radio.name).src = radio.value; };
)";

}  // namespace prt::cli
