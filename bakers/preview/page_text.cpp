#include "bakers/preview/page_text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "bakers/io/manifest/release.h"
#include "config/text/text.h"

namespace skybake {

std::string generator() { return fmt::format("{} {} preview", tool_name(), release()); }

std::string html_text(std::string_view text) {
    return config::replaced(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}});
}

std::string safe_in_script(std::string_view text) {
    return config::replaced(text, {{'<', "\\u003c"}});
}

std::string filled(std::string_view form, const std::map<std::string_view, std::string>& values) {
    std::string text;
    for (std::size_t at = 0;;) {
        const std::size_t open = form.find("{{", at);
        const std::size_t close = form.find("}}", open);
        if (close == std::string_view::npos) return text.append(form.substr(at));
        text.append(form.substr(at, open - at));
        text.append(values.at(form.substr(open + 2, close - open - 2)));
        at = close + 2;
    }
}

std::string head_html(const PreviewPage& page, std::string_view style) {
    return filled(embedded_text("head.html"), {{"generator", html_text(generator())},
                                               {"title", html_text(page.title)},
                                               {"style", std::string(embedded_text(style))}});
}

std::string_view kind_name(PictureKind kind) {
    constexpr std::array<std::string_view, 3> names = {"image", "scene", "plot"};
    return names[static_cast<std::size_t>(kind)];
}

namespace {

// Returns the width or height that a drawing of `report` states.
int svg_extent(std::string_view svg, std::string_view attribute) {
    const std::size_t at = svg.find(fmt::format(" {}=\"", attribute), svg.find("<svg"));
    if (at == std::string_view::npos) return 0;
    int value = 0;
    for (const char c : svg.substr(at + attribute.size() + 3)) {
        if (c < '0' || c > '9' || value > 100000) break;
        value = 10 * value + (c - '0');
    }
    return value;
}

std::string figure_html(const PagePicture& picture, const std::string& file,
                        const std::string& source) {
    return fmt::format(
        "<figure><img class=\"{}\" data-file=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\" "
        "src=\"{}\"><figcaption><b>{}</b> {}</figcaption></figure>\n",
        kind_name(picture.kind), html_text(file),
        html_text(picture.caption.empty() ? picture.title : picture.caption), picture.picture.width,
        picture.picture.height, source, html_text(picture.title), html_text(picture.caption));
}

// Returns the figures. Pictures of a sequence stay in their files; a new revision of a page asks for
// them by a new address.
std::string figures_html(const std::vector<PagePicture>& pictures, int revision) {
    const std::string query = revision > 0 ? fmt::format("?{}", revision) : "";
    std::string html;
    for (const PagePicture& picture : pictures) {
        const std::string file = picture.name + ".png";
        html +=
            figure_html(picture, file,
                        picture.sequence.empty() ? "data:image/png;base64," + base64(picture.png)
                                                 : file + query);
    }
    return html;
}

}  // namespace

PagePicture report_plot(const PageAsset& asset) {
    PagePicture plot;
    plot.name = asset.entry.name + "_report";
    plot.title = "Speed against error";
    plot.caption =
        "The plot shows what accuracy costs: the time of the bake against its error, for many "
        "variants.";
    plot.picture.width = svg_extent(asset.plot_svg, "width");
    plot.picture.height = svg_extent(asset.plot_svg, "height");
    plot.kind = PictureKind::plot;
    return plot;
}

std::string pictures_html(const PreviewPage& page) {
    std::string html;
    for (const PageTable& table : page.tables) {
        html += figures_html(table.pictures, page.watch_revision);
        for (const PageVariant& variant : table.variants) {
            if (variant.picture) html += figures_html({*variant.picture}, page.watch_revision);
        }
    }
    for (const PageScene& scene : page.scenes) {
        html += figures_html(scene.pictures, page.watch_revision);
    }
    for (const PageAsset& asset : page.assets) {
        html += figures_html(asset.pictures, page.watch_revision);
        if (asset.plot_svg.empty()) continue;
        html += figure_html(report_plot(asset), asset.entry.name + "_report.svg",
                            "data:image/svg+xml;base64," + base64(asset.plot_svg));
    }
    return html;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::string_view group = bytes.substr(at, 3);
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            bits = bits << 8 | (i < group.size() ? static_cast<std::uint8_t>(group[i]) : 0U);
        }
        // A group of n bytes makes n + 1 digits; the rest is padding.
        for (std::size_t i = 0; i < 4; ++i) {
            text += i <= group.size() ? digits[bits >> (18 - 6 * i) & 63] : '=';
        }
    }
    return text;
}

}  // namespace skybake
