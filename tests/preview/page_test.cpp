#include "bakers/preview/page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/io/manifest/metadata.h"
#include "bakers/preview/preview_files.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

using nlohmann::json;
using namespace std::string_literals;

std::size_t count(const std::string& text, const std::string& piece) {
    std::size_t found = 0;
    for (std::size_t at = text.find(piece); at != std::string::npos;
         at = text.find(piece, at + 1)) {
        ++found;
    }
    return found;
}

// Returns the text between the first `begin` and the next `end`.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t first = text.find(begin);
    if (first == std::string::npos) return "";
    const std::size_t from = first + begin.size();
    return text.substr(from, text.find(end, from) - from);
}

json data_of(const std::string& html) {
    return json::parse(
        between(html, "<script type=\"application/json\" id=\"preview\">", "</script>"));
}

PagePicture picture(const std::string& name) {
    return {{name, "Title of " + name, "Caption of " + name, Picture(4, 2)}, "\x89PNG\0\xff"s};
}

PreviewPage page_of(const std::string& name) {
    PreviewPage page;
    page.title = name;
    page.notes = {"a note on " + name};
    ManifestAsset entry = describe(testing::sample_table(name));
    entry.content = name;
    entry.error->worst = name;
    page.assets.push_back({std::move(entry), {picture(name)}, "<svg width=\"10\" height=\"20\"/>"});
    page.scenes.push_back({name, name, {picture("scene")}});
    PageTable sweep;
    sweep.title = name;
    sweep.content = name;
    sweep.pictures = {picture("sheet")};
    sweep.columns = {{name, "figure"}, {"text", ""}};
    sweep.variants = {
        {name, name + "/0000/", {{0.25, ""}, {std::nullopt, name}}, picture("variant")},
        {"", "", {{std::nullopt, ""}, {std::nullopt, ""}}, std::nullopt}};
    page.tables.push_back(std::move(sweep));
    return page;
}

// Names that end a script or an attribute, open a comment, or are no text at all.
const std::string hostile_names[] = {"</script><script>alert(1)</script>",
                                     "<!--<script>",
                                     "\"><img src=x onerror=alert(1)>",
                                     "' onload='alert(1)",
                                     "{{data}} {{style}}",
                                     "\xe2\x80\xa8 \xff\xfe",
                                     "&lt;b&gt; \\u003c \\"};

TEST(Page, NoNameBecomesMarkup) {
    const std::string plain = page_html(page_of("plain"));
    for (const std::string& name : hostile_names) {
        SCOPED_TRACE(name);
        const std::string html = page_html(page_of(name));
        for (const char* piece : {"<script", "</script", "<!--", "<img", "<style", "<title"}) {
            EXPECT_EQ(count(html, piece), count(plain, piece)) << piece;
        }
        EXPECT_EQ(count(between(html, "<title>", "</title>"), "<"), 0u);
    }
}

TEST(Page, SaysWhatItWasGiven) {
    for (const std::string& name : hostile_names) {
        if (name.find('\xff') != std::string::npos) continue;  // is replaced: JSON is UTF-8
        const json data = data_of(page_html(page_of(name)));
        EXPECT_EQ(data["title"], name);
        EXPECT_EQ(data["notes"][0], "a note on " + name);
        EXPECT_EQ(data["assets"][0]["name"], name);
        EXPECT_EQ(data["assets"][0]["error"]["lookup"]["max"], 7.1e-3);
        EXPECT_EQ(data["assets"][0]["pictures"][0]["width"], 4);
        EXPECT_EQ(data["assets"][0]["pictures"][1]["height"], 20);  // of the plot
        EXPECT_EQ(data["scenes"][0]["title"], name);
        const json& rows = data["tables"][0]["rows"];
        EXPECT_EQ(rows[0]["cells"][0]["value"], 0.25);
        EXPECT_TRUE(rows[0]["cells"][0]["text"].is_null());
        EXPECT_EQ(rows[0]["cells"][1]["value"], name);
        EXPECT_TRUE(rows[1]["cells"][0]["value"].is_null());
        EXPECT_TRUE(rows[1]["picture"].is_null());
    }
}

TEST(Page, NeedsNothingElse) {
    const std::string html = page_html(page_of("asset"));
    for (const char* piece : {"http:", "https:", "@import", "url(", "fetch("}) {
        EXPECT_EQ(count(html, piece), 0u) << piece;
    }
    EXPECT_EQ(count(html, "src="), 5u);  // of three assets and scenes, a sheet and a variant
    EXPECT_EQ(count(html, "src=\"data:image/"), 5u);
    EXPECT_EQ(count(html, "<link"), 1u);
    EXPECT_EQ(count(html, "<link rel=\"icon\" href=\"data:,\">"), 1u);
    EXPECT_EQ(count(html, page_state_name), 0u);  // only where it watches
    PreviewPage watched = page_of("asset");
    watched.watch_revision = 7;
    EXPECT_EQ(count(page_html(watched), page_state_name), 1u);
    EXPECT_EQ(count(page_html(watched), "revision = 7;"), 1u);
}

// A browser without scripts shows them, and pages are not twice as long for it.
TEST(Page, PicturesStandInTheHtmlOnce) {
    const std::string html = page_html(page_of("asset"));
    EXPECT_EQ(count(html, "data:image/png;base64,iVBORwD/"), 4u);
    EXPECT_EQ(count(html, "data:image/svg+xml;base64,"), 1u);
    const std::string figure = between(html, "data-file=\"asset.png\"", "</figure>");
    EXPECT_NE(figure.find("alt=\"Caption of asset\" width=\"4\" height=\"2\""), std::string::npos);
    EXPECT_NE(figure.find("<b>Title of asset</b> Caption of asset</figcaption>"),
              std::string::npos);
    // Each is found by the name that the page's data has of it.
    const json data = data_of(html);
    EXPECT_EQ(data["assets"][0]["pictures"][0]["file"], "asset.png");
    EXPECT_EQ(data["assets"][0]["pictures"][1]["kind"], "plot");
}

TEST(Page, HasTheFrameThatBrowsersWant) {
    const std::string html = page_html(page_of("asset"));
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
    EXPECT_TRUE(html.ends_with("</html>\n"));
    EXPECT_EQ(count(html, "<meta charset=\"utf-8\">"), 1u);
    EXPECT_EQ(count(html, "name=\"viewport\""), 1u);
    EXPECT_EQ(count(html, "prefers-color-scheme: dark"), 1u);
    EXPECT_EQ(count(html, "{{"), 0u);
    for (const char* tag : {"html", "head", "body", "style", "script", "title"}) {
        EXPECT_EQ(
            count(html, std::string("<") + tag + ">") + count(html, std::string("<") + tag + " "),
            count(html, std::string("</") + tag + ">"))
            << tag;
    }
}

TEST(Page, StateIsOneCallThatNoDiagnosticEnds) {
    PageState state{
        3, 0.25, true, false, {{config::Severity::error, "E0102", "</script>\n\"", {}, ""}}};
    state.diagnostics[0].where = {"a.toml", 3, 5, 2, "x = '\\'"};
    const std::string text = page_state_text(state);
    ASSERT_TRUE(text.starts_with("skybakePreview(") && text.ends_with(");\n"));
    const json data = json::parse(text.substr(15, text.size() - 18));
    EXPECT_EQ(data["revision"], 3);
    EXPECT_EQ(data["quality"], "full");
    EXPECT_EQ(data["diagnostics"][0]["message"], "</script>\n\"");
    EXPECT_EQ(data["diagnostics"][0]["text"], "x = '\\'");
    EXPECT_EQ(count(text, "<"), 0u);
}

TEST(Base64, IsThatOfRfc4648) {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

TEST(PreviewFiles, KnowTheirOwn) {
    const testing::TemporaryFolder folder;
    PreviewPage page = page_of("asset");
    page.title = "\"file\":\"holiday.png\"";
    page.retired = {"older.png"};
    const std::vector<NamedFile> files = preview_files(page);
    const std::vector<std::string> names = preview_file_names(page);
    ASSERT_EQ(files.size(), 5u);
    EXPECT_EQ(files.back().name, "index.html");
    EXPECT_TRUE(earlier_preview_files(folder.path()).empty());
    for (const NamedFile& file : files) testing::write_bytes(folder / file.name, file.bytes);

    const std::vector<std::string> earlier = earlier_preview_files(folder.path());
    EXPECT_TRUE(foreign_preview_files(folder.path(), names, earlier).empty());
    testing::write_bytes(folder / "older.png", "p");
    EXPECT_TRUE(foreign_preview_files(folder.path(), {"older.png"}, earlier).empty());
    // A picture that the page there does not name is somebody else's.
    testing::write_bytes(folder / "holiday.png", "p");
    const auto foreign = foreign_preview_files(folder.path(), {"holiday.png"}, earlier);
    EXPECT_EQ(testing::first_code(foreign), "E0303");
    // So is everything beside a page of another program's.
    testing::write_bytes(folder / "index.html", "<!DOCTYPE html><title>skybake</title>");
    EXPECT_TRUE(earlier_preview_files(folder.path()).empty());
    EXPECT_EQ(foreign_preview_files(folder.path(), names, {}).size(), files.size());
}

}  // namespace
}  // namespace skybake
