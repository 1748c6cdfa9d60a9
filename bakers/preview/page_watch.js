// Only in pages of `preview --watch`. A page from file:// may not fetch, but it may load scripts: the
// state lies in one beside it, which is loaded again and again and calls skybakePreview.
(() => {
    let revision = {{revision}};
    const sign = document.createElement('div');
    sign.className = 'watch';
    sign.setAttribute('role', 'status');
    document.body.append(sign);

    // Loads the change, which lies in another script beside the page. A live page without WebGL is written anew.
    function renew() {
        const live = window.skybakeLive;
        if (live && live.failed) {
            location.reload();
            return;
        }
        load(live ? 'live_scene.js' : 'preview_page.js');
    }
    async function replace(made, replaced) {
        try {
            await replaced();
        } catch (error) {
            sign.textContent = error.message;
        }
        revision = made;
        look();
    }
    // Live pages replace what they render, and the camera stays; others replace their pictures.
    window.skybakeScene = (made, scene) => replace(made, async () => {
        await window.skybakeLive.begun;
        await window.skybakeLive.replace(scene);
    });
    window.skybakePage = (made, preview, figures) => replace(made, () => window.skybakeReplace(preview, figures));

    // A recipe's texts, as texts.
    function line(name, content, className) {
        const made = document.createElement(name);
        made.textContent = content;
        if (className) made.className = className;
        return made;
    }
    function diagnosticBlock(diagnostic) {
        const block = line('div', '', 'diagnostic');
        const head = line('div', '');
        head.append(line('strong', `${diagnostic.severity} ${diagnostic.code}`, diagnostic.severity),
            ` ${diagnostic.message}`);
        const where = diagnostic.line > 0
            ? `${diagnostic.file}:${diagnostic.line}:${diagnostic.column}` : diagnostic.file;
        const excerpt = diagnostic.line > 0 && diagnostic.text
            ? `\n${diagnostic.text}\n${' '.repeat(Math.max(0, diagnostic.column - 1))}${'^'.repeat(Math.max(1, diagnostic.length))} ${diagnostic.label}`
            : diagnostic.label ? `\n${diagnostic.label}` : '';
        block.append(head);
        if (where || excerpt) block.append(line('pre', where + excerpt));
        return block;
    }

    let told = '';
    function tell(state) {
        const wrong = state.diagnostics.some((diagnostic) => diagnostic.severity === 'error');
        sign.className = state.ended ? 'watch ended' : wrong ? 'watch wrong' : 'watch';
        sign.textContent = state.ended ? 'the recipe is no longer watched'
            : wrong ? 'watching: the pictures are those before the mistake'
            : state.quality === 'full' ? `watching: full quality, rendered in ${state.seconds.toFixed(1)} s`
            : `watching: a draft, rendered in ${state.seconds.toFixed(2)} s; full quality is on its way`;
        if (told === JSON.stringify(state.diagnostics)) return;
        told = JSON.stringify(state.diagnostics);
        const box = line('div', '', wrong ? 'notice wrong' : 'notice');
        const blocks = (severity) => state.diagnostics.filter((one) => one.severity === severity).map(diagnosticBlock);
        const warnings = blocks('warning');
        box.append(...blocks('error'));
        if (warnings.length > 0) {
            const folded = document.createElement('details');
            folded.append(line('summary', warnings.length === 1 ? '1 warning' : `${warnings.length} warnings`), ...warnings);
            box.append(folded);
        }
        document.getElementById('diagnostics').replaceChildren(...(state.diagnostics.length > 0 ? [box] : []));
    }

    window.skybakePreview = (state) => {
        if (state.revision !== revision) {
            renew();
            return;
        }
        tell(state);
        if (!state.ended) setTimeout(look, 100);
    };
    function load(name) {
        const script = document.createElement('script');
        script.src = `${name}?${Date.now()}`;
        script.onload = () => script.remove();
        script.onerror = () => {
            script.remove();
            setTimeout(look, 1000);
        };
        document.head.append(script);
    }
    function look() {
        load('preview_state.js');
    }
    look();
})();
