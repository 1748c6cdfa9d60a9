#include "cli/watch_preview.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/io/atomic_file.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/draft.h"
#include "cli/bake_progress.h"
#include "cli/bake_selection.h"
#include "cli/console.h"
#include "cli/event_line.h"
#include "cli/interrupt.h"
#include "cli/preview_output.h"
#include "cli/watched_files.h"
#include "config/recipe_sources.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Diagnostic;
using config::Outcome;

class Watch {
  public:
    Watch(const Invocation& invocation, PreviewRequest request, Console& console)
        : invocation_(invocation), request_(std::move(request)), console_(console) {
        request_.options.draft = true;
    }

    ExitCode run() {
        std::error_code error;
        const bool there = fs::exists(request_.paths[0], error);
        do {
            const ExitCode code = look_again();
            if (interrupted()) break;
            if (!there) return code;
        } while (exit_code_ == ExitCode::done && files_.wait());
        state_.ended = true;
        tell();
        return interrupted() ? ExitCode::interrupted : exit_code_;
    }

  private:
    // One round: from the recipe to the page, or to the diagnostics on it.
    ExitCode look_again() {
        const auto start = std::chrono::steady_clock::now();
        Outcome<PreviewPage> page = draft_page();
        if (interrupted()) return ExitCode::interrupted;
        const ExitCode code = console_.report(page.diagnostics);
        state_.diagnostics = std::move(page.diagnostics);
        // A recipe that was never right yet gets a page without pictures.
        if (!page.value && state_.revision == 0) page.value.emplace().title = title();
        if (page.value && !write(*page.value)) return exit_code_;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        if (page.value) state_.seconds = elapsed.count();
        tell();
        if (code == ExitCode::done) {
            console_.note(fmt::format("{} in {:.2f} s\n", (request_.output / page_name).string(),
                                      elapsed.count()));
        }
        return code;
    }

    std::string title() const { return request_.paths[0].filename().string(); }

    Outcome<PreviewPage> draft_page() {
        follow_inputs();
        auto selection = select_bakes(invocation_);
        Outcome<PreviewPage> outcome;
        outcome.diagnostics = std::move(selection.diagnostics);
        if (!selection.value) return outcome;
        good_inputs_ = selection.value->recipe.inputs;
        follow_inputs();
        add(outcome, draft_assets(*selection.value));
        return outcome;
    }

    Outcome<PreviewPage> draft_assets(const BakeSelection& selection) {
        const config::Recipe draft = draft_of(selection.recipe);
        std::vector<config::Bake> bakes;
        for (const config::Bake& bake : draft.parameters.bakes) {
            for (const config::Bake& wanted : selection.bakes) {
                if (wanted.name == bake.name) bakes.push_back(bake);
            }
        }
        BakeProgress progress("preview", console_);
        const BakeOptions options{selection.threads, Certification::off, &progress};
        Outcome<PreviewPage> outcome;
        const auto assets = bake_assets(draft, bakes, title(), options, &baked_);
        outcome.diagnostics = assets.diagnostics;
        if (!assets.value) return outcome;
        PreviewOptions pictures = request_.options;
        pictures.progress = &progress;
        pictures.memory = &pictures_;
        add(outcome, make_preview(*assets.value, pictures));
        return outcome;
    }

    static void add(Outcome<PreviewPage>& outcome, Outcome<PreviewPage> page) {
        outcome.value = std::move(page.value);
        outcome.diagnostics.insert(outcome.diagnostics.end(), page.diagnostics.begin(),
                                   page.diagnostics.end());
    }

    // What the recipe reads now, even if it is wrong, and what it read when it was right.
    void follow_inputs() {
        config::DiagnosticList ignored;
        std::vector<fs::path> inputs =
            config::read_sources(request_.paths[0], invocation_.values("set"), ignored).inputs;
        inputs.insert(inputs.end(), good_inputs_.begin(), good_inputs_.end());
        files_.follow(inputs);
    }

    bool write(PreviewPage& page) {
        page.watch_revision = state_.revision + 1;
        std::vector<std::string> paths;
        exit_code_ = write_preview(page, request_, console_, paths);
        if (exit_code_ != ExitCode::done) return false;
        if (state_.revision == 0) {
            console_.result(console_.display().json
                                ? event_line({{"event", "watching"}, {"page", paths.back()}})
                                : paths.back() + "\n");
        }
        state_.revision = page.watch_revision;
        request_.force = true;  // from now on the files are ours
        return true;
    }

    // A page from file:// reads the state beside it.
    void tell() {
        if (state_.revision == 0) return;
        const auto written =
            write_file_atomically(request_.output / page_state_name, page_state_text(state_));
        if (!written.value) exit_code_ = console_.report(written.diagnostics);
    }

    const Invocation& invocation_;
    PreviewRequest request_;
    Console& console_;
    WatchedFiles files_;
    std::vector<fs::path> good_inputs_;
    AssetMemory baked_;
    PictureMemory pictures_;
    PageState state_;
    ExitCode exit_code_ = ExitCode::done;  // of writing: what ends the watch
};

}  // namespace

ExitCode watch_preview(const Invocation& invocation, const PreviewRequest& request,
                       Console& console) {
    return Watch(invocation, request, console).run();
}

}  // namespace skybake::cli
