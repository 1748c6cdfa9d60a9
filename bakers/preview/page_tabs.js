'use strict';
// Tabs, by the pattern of the ARIA Authoring Practices: the arrow keys, Home and End choose a tab, and
// Tab goes on to what the tab shows.
//   tabbed('Channels', [{title: 'red', content: element}, ...]) returns an element.
let tabLists = 0;
function tabbed(label, choices) {
    const id = `tabs-${++tabLists}`;
    const list = document.createElement('div');
    list.className = 'tabs';
    list.setAttribute('role', 'tablist');
    list.setAttribute('aria-label', label);
    const tabs = choices.map((choice, i) => {
        const tab = document.createElement('button');
        tab.type = 'button';
        tab.id = `${id}-${i}`;
        tab.setAttribute('role', 'tab');
        tab.setAttribute('aria-controls', `${id}-panel-${i}`);
        tab.textContent = choice.title;
        tab.addEventListener('click', () => select(i));
        list.append(tab);
        choice.content.id = `${id}-panel-${i}`;
        choice.content.setAttribute('role', 'tabpanel');
        choice.content.setAttribute('aria-labelledby', tab.id);
        return tab;
    });
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
    const whole = document.createElement('div');
    whole.className = 'tabbed';
    whole.append(list, ...choices.map((choice) => choice.content));
    return whole;
}
