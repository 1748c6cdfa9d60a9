#include "cli/preview.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/math/intermediates.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/check_options.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "config/recipe/recipe_sources.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

// Ends the work once a file is saved, because the work belongs to the text before.
class UntilSaved : public BakeProgress {
  public:
    UntilSaved(Console& console, const WatchedFiles& files)
        : BakeProgress("full quality", console), files_(files) {}

    bool cancelled() const override { return BakeProgress::cancelled() || saved(); }

  private:
    // One of the threads looks at the files from time to time.
    bool saved() const {
        const std::unique_lock lock(look_mutex_, std::try_to_lock);
        const auto now = std::chrono::steady_clock::now();
        if (lock && !saved_ && now - looked_ > look_every) {
            looked_ = now;
            saved_ = files_.changed();
        }
        return saved_;
    }

    static constexpr std::chrono::milliseconds look_every{50};

    const WatchedFiles& files_;
    mutable std::mutex look_mutex_;
    mutable std::chrono::steady_clock::time_point looked_;
    mutable std::atomic<bool> saved_ = false;
};

// This memo holds what earlier rounds of one quality have made.
struct RoundMemo {
    AssetMemo assets;
    PictureMemo pictures;
};

class Watch {
  public:
    Watch(const Invocation& invocation, PreviewRequest request, Console& console)
        : invocation_(invocation), request_(std::move(request)), console_(console) {
        full_.assets = ready_.assets();
    }

    ExitCode run() {
        std::error_code error;
        const bool there = fs::exists(request_.paths[0], error);
        do {
            const ExitCode code = look_again();
            if (interrupted()) break;
            if (!there) return code;
            if (code == ExitCode::done) refine();
        } while (exit_code_ == ExitCode::done && files_.wait());
        state_.ended = true;
        tell();
        return interrupted() ? ExitCode::interrupted : exit_code_;
    }

  private:
    // Runs one round, from the recipe to the page or to the diagnostics on the page.
    ExitCode look_again() {
        const Stopwatch stopwatch;
        Outcome<PreviewPage> page = draft_page();
        if (interrupted()) return ExitCode::interrupted;
        const ExitCode code = console_.report(page.diagnostics);
        state_.diagnostics = std::move(page.diagnostics);
        // A recipe that has been wrong since the start gets a page without pictures.
        if (!page.value && state_.revision == 0) page.value.emplace().title = title();
        if (page.value && !write(*page.value)) return exit_code_;
        const double seconds = stopwatch.seconds();
        if (page.value) {
            state_.seconds = seconds;
            state_.full = false;
        }
        tell();
        if (code == ExitCode::done) note_made("a draft", seconds);
        return code;
    }

    // Makes the same page at full quality. It gives up if a file is saved before it is done.
    void refine() {
        if (!selection_ || exit_code_ != ExitCode::done) return;
        const Stopwatch stopwatch;
        bool given_up = false;
        Outcome<PreviewPage> page = [&] {
            UntilSaved progress(console_, files_);
            request_.options.early_page = [&](const PreviewPage& clouds) {
                if (!progress.cancelled()) show_clouds(clouds, stopwatch);
            };
            auto made = page_of(*selection_, selection_->recipe, false, full_, progress);
            request_.options.early_page = nullptr;
            given_up = progress.cancelled();
            return made;
        }();
        if (given_up || exit_code_ != ExitCode::done) return;
        if (!page.value) {
            console_.report(page.diagnostics);
            state_.diagnostics = std::move(page.diagnostics);
            return tell();
        }
        state_.full = true;
        state_.seconds = stopwatch.seconds();
        if (!write(*page.value)) return;
        tell();
        note_made("full quality", state_.seconds);
    }

    // Puts pictures of clouds, or a live page, at full quality into the page of the draft.
    void show_clouds(const PreviewPage& clouds, const Stopwatch& stopwatch) {
        PreviewPage page = shown_;
        if (!clouds.live_scene.empty()) page.live_scene = clouds.live_scene;
        for (PageScene& scene : page.scenes) {
            for (const PageScene& better : clouds.scenes) {
                if (better.title == scene.title) scene = better;
            }
        }
        for (PageAsset& asset : page.assets) {
            for (const PageAsset& better : clouds.assets) {
                if (better.entry.name == asset.entry.name && !better.pictures.empty())
                    asset = better;
            }
        }
        if (!write(page)) return;
        tell();
        note_made("clouds at full quality", stopwatch.seconds());
    }

    void note_made(const char* what, double seconds) {
        console_.note(fmt::format("{}: {} in {:.2f} s\n", request_.page_path(), what, seconds));
    }

    std::string title() const { return request_.paths[0].filename().string(); }

    Outcome<PreviewPage> draft_page() {
        selection_.reset();
        follow_inputs();
        auto selection = select_bakes(invocation_);
        Outcome<PreviewPage> outcome;
        outcome.diagnostics = std::move(selection.diagnostics);
        if (!selection.value) return outcome;
        good_inputs_ = selection.value->recipe.inputs;
        follow_inputs();
        auto unused = unused_options(lit_pictures_of(selection.value->bakes), request_.options);
        if (!unused.empty()) {
            add(outcome, {{}, std::move(unused)});
            return outcome;
        }
        selection_ = std::move(*selection.value);
        BakeProgress progress("draft", console_);
        add(outcome, page_of(*selection_, draft_of(selection_->recipe, request_.draft_edge), true,
                             draft_, progress));
        return outcome;
    }

    // Makes the page of the selected bakes, with the values that `recipe` gives them.
    Outcome<PreviewPage> page_of(const BakeSelection& selection, const Recipe& recipe, bool draft,
                                 RoundMemo& memory, BakeProgress& progress) {
        std::vector<Bake> bakes;
        for (const Bake& bake : recipe.parameters.bakes) {
            for (const Bake& wanted : selection.bakes) {
                if (wanted.name == bake.name) bakes.push_back(bake);
            }
        }
        const int count = static_cast<int>(bakes.size());
        // Light that this round and the one before need alike stays.
        pictures_need_ = intermediates_.expect(needs_of_pictures(recipe));
        const BakeOptions options{
            .threads = selection.threads,
            .certification = draft ? Certification::off : certification_of(request_.options),
            .progress = &progress,
            .intermediates = &intermediates_};
        const BakeStages stages{
            &progress,
            count + picture_stages(bakes.size(), lit_pictures_of(bakes), request_.options)};
        Outcome<PreviewPage> outcome;
        const auto assets = bake_assets(recipe, bakes, title(), options, &memory.assets, stages);
        outcome.diagnostics = assets.diagnostics;
        if (!assets.value) return outcome;
        PreviewOptions pictures = request_.options;
        pictures.draft = draft;
        pictures.progress = &progress;
        pictures.stages_before = count;
        pictures.memory = &memory.pictures;
        pictures.intermediates = &intermediates_;
        pictures.light = light_;
        add(outcome, make_preview(*assets.value, pictures));
        return outcome;
    }

    static void add(Outcome<PreviewPage>& outcome, Outcome<PreviewPage> page) {
        outcome.value = std::move(page.value);
        outcome.diagnostics.insert(outcome.diagnostics.end(), page.diagnostics.begin(),
                                   page.diagnostics.end());
    }

    // Follows the files that the recipe reads now, even if it is wrong, and those that it read when
    // it was last right.
    void follow_inputs() {
        config::DiagnosticList ignored;
        std::vector<fs::path> inputs =
            config::read_sources(request_.paths[0], invocation_[options::set], ignored).inputs;
        inputs.insert(inputs.end(), good_inputs_.begin(), good_inputs_.end());
        files_.follow(inputs);
    }

    bool write(PreviewPage& page) {
        page.watch_revision = state_.revision + 1;
        exit_code_ = write_preview(page, request_, console_);
        if (exit_code_ != ExitCode::done) return false;
        if (state_.revision == 0) {
            const std::string path = request_.page_path();
            console_.result(console_.json() ? event_line({{"event", "watching"}, {"page", path}})
                                            : path + "\n");
        }
        state_.revision = page.watch_revision;
        shown_ = page;
        request_.force = true;  // from now on the files are from this run
        return true;
    }

    // Writes the state beside the page. A page opened from file:// reads it there.
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
    std::optional<BakeSelection> selection_;  // of the draft that is shown
    // Pictures of one round and of the next may be made from the same light.
    ReadyFiles ready_{request_};
    Intermediates intermediates_{BakeOptions().held_voxel_bytes, ready_.kept()};
    Intermediates::Expected pictures_need_;
    // A save of a cloud leaves the light alone.
    std::shared_ptr<PictureLight> light_ =
        std::make_shared<PictureLight>(&intermediates_, ready_.light());
    RoundMemo draft_;
    RoundMemo full_;
    PageState state_;
    PreviewPage shown_;
    ExitCode exit_code_ = ExitCode::done;  // of writing; a failure ends the watch
};

}  // namespace

ExitCode watch_preview(const Invocation& invocation, const PreviewRequest& request,
                       Console& console) {
    return Watch(invocation, request, console).run();
}

}  // namespace skybake::cli
