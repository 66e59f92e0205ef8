// Points of the plots: hovering over a point or moving to it with the keyboard names it and marks
// the rows of the tables that show the same measurement. Without this script, each point has a
// title.
'use strict';

{
    const measurements = JSON.parse(document.getElementById('measurements').textContent);
    const tip = document.createElement('div');
    tip.className = 'tip';
    tip.setAttribute('role', 'status');
    tip.hidden = true;
    document.body.append(tip);

    const sameRow = (row) => document.querySelectorAll(`[data-row="${row}"]`);
    const hasPicture = (row) => document.querySelector(`figure[data-row="${row}"] img`) !== null;

    function describe(row) {
        const m = measurements[row];
        const lines = [`${m.settings} on path ${m.path}`, m.time, m.errors];
        return lines.filter(Boolean).join('\n');
    }

    // Puts the tip beside the element, inside the window.
    function showTip(at, row) {
        const hint = hasPicture(row)
            ? 'Click or press Enter for the picture.'
            : 'This page has no picture of it.';
        tip.textContent = `${describe(row)}\n${hint}`;
        tip.hidden = false;
        const box = at.getBoundingClientRect();
        const left = Math.min(box.right + 12, innerWidth - tip.offsetWidth - 8);
        const below = box.bottom + 10 + tip.offsetHeight < innerHeight;
        tip.style.left = `${Math.max(8, left)}px`;
        const top = below ? box.bottom + 10 : box.top - tip.offsetHeight - 10;
        tip.style.top = `${Math.max(8, top)}px`;
    }

    let lit = [];
    function light(row) {
        lit.forEach((other) => other.classList.remove('lit'));
        lit = row === undefined ? [] : [...sameRow(row)];
        lit.forEach((other) => other.classList.add('lit'));
    }

    function enter(event) {
        const at = event.target.closest('[data-row]');
        if (at) {
            light(at.dataset.row);
            if (at.matches('.point')) {
                showTip(at, at.dataset.row);
            }
        }
    }

    function leave() {
        light(undefined);
        tip.hidden = true;
    }

    document.addEventListener('pointerover', enter);
    document.addEventListener('pointerout', leave);
    document.addEventListener('focusin', enter);
    document.addEventListener('focusout', leave);
    document.addEventListener('scroll', () => { tip.hidden = true; }, { passive: true });

    function open(point) {
        if (hasPicture(point.dataset.row)) {
            leave();
            openViewer(Number(point.dataset.row), point.closest('.plot').dataset.set, point);
        }
    }

    // Each plot is one stop of the Tab key. The arrow keys go from point to point: in a plot of
    // bars from bar to bar, otherwise in order of the x axis.
    function addKeys(plot) {
        const points = [...plot.querySelectorAll('.point')];
        points.sort((a, b) => (a.getAttribute('cx') ?? 0) - (b.getAttribute('cx') ?? 0));
        points.forEach((point, index) => {
            point.setAttribute('tabindex', index === 0 ? 0 : -1);
            point.setAttribute('role', 'button');
            point.setAttribute('aria-label', describe(point.dataset.row).replaceAll('\n', ', '));
            point.querySelector('title')?.remove(); // The tip takes its place.
            point.addEventListener('click', () => open(point));
        });
        plot.addEventListener('keydown', (event) => {
            const steps = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };
            const index = points.indexOf(document.activeElement);
            const ends = { Home: 0, End: points.length - 1 };
            const next = points[ends[event.key] ?? index + (steps[event.key] ?? 0)];
            if (event.key === 'Enter' || event.key === ' ') {
                event.preventDefault();
                open(points[index]);
            } else if (event.key in steps || event.key in ends) {
                event.preventDefault();
                if (next && next !== points[index]) {
                    points[index].setAttribute('tabindex', -1);
                    next.setAttribute('tabindex', 0);
                    next.focus();
                }
            } else if (event.key === 'Escape') {
                tip.hidden = true;
            }
        });
    }

    document.querySelectorAll('.plot').forEach((plot) => {
        if (plot.querySelector('.point')) {
            addKeys(plot);
        }
    });
}
