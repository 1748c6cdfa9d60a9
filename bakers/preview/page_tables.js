'use strict';
// Tables that a reader sorts.

const classes = (number, wraps) =>
    [number ? 'number' : '', wraps ? 'wraps' : ''].join(' ').trim() || null;

// columns: {title, number, wraps}; rows: arrays of cells {text, value, content, wraps}. A cell sorts by
// its value (numbers, then texts, then what has none), shows its content or its text.
function sortableTable(columns, rows, label) {
    const body = element('tbody');
    const heads = [];
    const lines = rows.map((cells) => {
        const line = element('tr', {}, ...cells.map((cell, i) => element('td',
            {class: classes(columns[i].number, cell.wraps)}, cell.content || cell.text)));
        return {cells, line};
    });
    body.append(...lines.map((row) => row.line));
    function sortBy(column) {
        const ascending = heads[column].getAttribute('aria-sort') !== 'ascending';
        heads.forEach((head, i) => head.setAttribute(
            'aria-sort', i !== column ? 'none' : ascending ? 'ascending' : 'descending'));
        const sorted = lines.slice().sort((a, b) => compare(a.cells[column], b.cells[column], ascending));
        body.append(...sorted.map((row) => row.line));
    }
    columns.forEach((column, i) => {
        const plain = column.title === '' || rows.length < 2;
        heads.push(element('th', {scope: 'col', class: classes(column.number, column.wraps),
                                  'aria-sort': plain ? null : 'none'},
            plain ? column.title
                  : element('button', {type: 'button', onclick: () => sortBy(i)}, column.title)));
    });
    return element('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': label},
        element('table', {}, element('thead', {}, element('tr', {}, ...heads)), body));
}
// Missing values are last whichever way the table is sorted.
function compare(a, b, ascending) {
    const missing = (cell) => cell.value === null || cell.value === undefined;
    if (missing(a) || missing(b)) return missing(a) - missing(b);
    const both = typeof a.value === 'number' && typeof b.value === 'number';
    const order = both ? a.value - b.value
                       : String(a.value).localeCompare(String(b.value), 'en', {numeric: true});
    return ascending ? order : -order;
}
const text = (value, wraps) => ({text: value, value, wraps});
const amount = (value, shown) => value === null || value === undefined
    ? {text: '–', value: null} : {text: shown(value), value};
