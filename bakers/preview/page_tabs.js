'use strict';
// Tabs, by the pattern of the ARIA Authoring Practices: the arrow keys, Home and End choose a tab, and
// Tab goes on to what the tab shows.
//   tabbed('Channels', [{title: 'red', content: element}, ...]) returns an element.
let tabLists = 0;
function tabbed(label, choices) {
    const id = `tabs-${++tabLists}`;
    const tabs = choices.map(({title, content}, i) => {
        content.id = `${id}-panel-${i}`;
        content.setAttribute('role', 'tabpanel');
        content.setAttribute('aria-labelledby', `${id}-${i}`);
        return element('button', {type: 'button', id: `${id}-${i}`, role: 'tab', 'aria-controls': content.id,
                                  onclick: () => select(i)}, title);
    });
    const list = element('div', {class: 'tabs', role: 'tablist', 'aria-label': label}, ...tabs);
    function select(chosen) {
        tabs.forEach((tab, i) => {
            tab.setAttribute('aria-selected', String(i === chosen));
            tab.tabIndex = i === chosen ? 0 : -1;
            choices[i].content.hidden = i !== chosen;
        });
    }
    list.addEventListener('keydown', (event) => {
        const at = tabs.indexOf(document.activeElement);
        const to = {ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1}[event.key];
        if (at < 0 || to === undefined) return;
        event.preventDefault();
        const next = (to + tabs.length) % tabs.length;
        select(next);
        tabs[next].focus();
    });
    select(0);
    return element('div', {class: 'tabbed'}, list, ...choices.map(({content}) => content));
}
