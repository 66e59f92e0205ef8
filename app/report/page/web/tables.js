// Tables: sorting by any column, filtering rows, saving what is shown as CSV. Without this script
// the tables are complete, in the order of the report.
'use strict';

{
    const manyRows = 10; // A table with fewer rows has no filter.

    const bodyOf = (table) => table.tBodies[0];
    const rowsOf = (table) => [...bodyOf(table).rows];
    const textOf = (cell) => cell.textContent.trim().replace(/\s+/g, ' ');

    function element(name, properties, ...children) {
        const made = Object.assign(document.createElement(name), properties);
        made.append(...children);
        return made;
    }

    // --- sorting ----------------------------------------------------------------------------

    // Compares two cells. Cells of a column of numbers compare by the first number in each; a cell
    // without a number comes last in both directions.
    function compareCells(a, b, isText, sign) {
        const x = textOf(a);
        const y = textOf(b);
        if (isText) {
            return sign * x.localeCompare(y, 'en', { numeric: true });
        }
        const p = Number.parseFloat(x);
        const q = Number.parseFloat(y);
        const missing = Number.isNaN(p) - Number.isNaN(q);
        return missing || Number.isNaN(p) ? missing : sign * (p - q);
    }

    // Sorts ascending, then descending, then in the order of the report.
    function sortBy(table, header) {
        const next = { none: 'ascending', ascending: 'descending', descending: 'none' };
        const order = next[header.getAttribute('aria-sort') ?? 'none'];
        for (const other of table.tHead.rows[0].cells) {
            other.removeAttribute('aria-sort');
        }
        const rows = rowsOf(table);
        rows.sort((a, b) => a.dataset.order - b.dataset.order);
        if (order !== 'none') {
            const column = header.cellIndex;
            const isText = header.classList.contains('l') || column === 0;
            const sign = order === 'ascending' ? 1 : -1;
            header.setAttribute('aria-sort', order);
            rows.sort((a, b) => compareCells(a.cells[column], b.cells[column], isText, sign));
        }
        bodyOf(table).append(...rows);
    }

    function addSorting(table) {
        rowsOf(table).forEach((row, index) => {
            row.dataset.order = index;
        });
        for (const header of table.tHead.rows[0].cells) {
            const button = element('button', { type: 'button' });
            button.append(...header.childNodes);
            button.addEventListener('click', () => sortBy(table, header));
            header.append(button);
        }
    }

    // --- filtering --------------------------------------------------------------------------

    // Splits "aa=4,af=16" into a map from settings to steps.
    function settingsOf(row) {
        const pairs = (row.dataset.settings ?? '').split(',').filter(Boolean);
        return new Map(pairs.map((pair) => pair.split('=')));
    }

    // Returns a map from each setting that differs between the rows to its steps.
    function stepsOf(rows) {
        const steps = new Map();
        for (const row of rows) {
            for (const [key, step] of settingsOf(row)) {
                steps.set(key, (steps.get(key) ?? new Set()).add(step));
            }
        }
        return new Map([...steps].filter(([, values]) => values.size > 1));
    }

    // Points whose row is filtered out of the table become pale in the plot of its set.
    function dimPoints(table) {
        for (const { dataset, hidden } of rowsOf(table)) {
            const plot = `.plot[data-set="${table.dataset.set}"]`;
            const points = document.querySelectorAll(`${plot} .point[data-row="${dataset.row}"]`);
            points.forEach((point) => point.classList.toggle('dim', hidden));
        }
    }

    function addFilter(table, tools) {
        const rows = rowsOf(table);
        const search = element('input', { type: 'search', placeholder: 'text of a row' });
        const count = element('span', { className: 'count' });
        count.setAttribute('role', 'status');
        const selects = [...stepsOf(rows)].map(([key, steps]) => {
            const select = element('select', { name: key }, new Option('any', ''));
            [...steps].forEach((step) => select.add(new Option(step, step)));
            return select;
        });
        const apply = () => {
            const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
            for (const row of rows) {
                const text = row.textContent.toLowerCase();
                const settings = settingsOf(row);
                const fits = ({ name, value }) => !value || settings.get(name) === value;
                row.hidden = !words.every((word) => text.includes(word)) || !selects.every(fits);
            }
            const shown = rows.filter((row) => !row.hidden).length;
            count.textContent = `${shown} of ${rows.length} rows`;
            if (table.id === 'combinations') {
                dimPoints(table);
            }
        };
        tools.append(element('label', {}, 'Filter', search));
        selects.forEach((select) => tools.append(element('label', {}, select.name, select)));
        tools.append(count);
        tools.addEventListener('input', apply);
        tools.addEventListener('change', apply);
        apply();
    }

    // --- saving -----------------------------------------------------------------------------

    function csvOf(table) {
        const rows = [table.tHead.rows[0], ...rowsOf(table).filter((row) => !row.hidden)];
        // A spreadsheet takes a text that begins like this for a formula.
        const safe = (text) => (/^[=+\-@\t]/.test(text) && isNaN(text) ? `'${text}` : text);
        const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
        const quote = (text) => quoted(safe(text));
        const lineOf = (row) => [...row.cells].map((cell) => quote(textOf(cell))).join(',');
        return rows.map((row) => `${lineOf(row)}\r\n`).join('');
    }

    function save(table) {
        const url = URL.createObjectURL(new Blob([csvOf(table)], { type: 'text/csv' }));
        const link = element('a', { href: url, download: `${table.id}.csv` });
        document.body.append(link);
        link.click();
        link.remove();
        setTimeout(() => URL.revokeObjectURL(url), 1000);
    }

    for (const table of document.querySelectorAll('.table table')) {
        const around = table.closest('.table');
        addSorting(table);
        if (rowsOf(table).length >= manyRows) {
            const tools = element('div', { className: 'tools' });
            addFilter(table, tools);
            around.prepend(tools);
        }
        const button = element('button', { type: 'button', className: 'save' });
        button.textContent = 'Save this table as CSV';
        button.addEventListener('click', () => save(table));
        around.append(button);
    }

    // On paper, every part is shown.
    let closed = [];
    window.addEventListener('beforeprint', () => {
        closed = [...document.querySelectorAll('details:not([open])')];
        closed.forEach((details) => { details.open = true; });
    });
    window.addEventListener('afterprint', () => {
        closed.forEach((details) => { details.open = false; });
    });
}
