#include "courant/reporting/page_frame.hpp"

#include "courant/plotting/figure.hpp"

namespace courant {
namespace {

using plot::element;
using plot::Markup;

// What stands on a page of any frame: colours and types, ladders, formulas, tables, figures and the charts that they become.
constexpr std::string_view style_of_content = R"css(
:root{color-scheme:light dark;--page:#fffefb;--text:#1c1c1a;--soft:#5d5c57;--rule:#77756e;--faint:#e4e1d8;
--good:#00664a;--bad:#a63a00;
--serif:"STIX Two Text","Libertinus Serif","Latin Modern Roman",Charter,"Bitstream Charter",Georgia,"DejaVu Serif",serif;
--mono:ui-monospace,"SF Mono",Menlo,Consolas,"DejaVu Sans Mono",monospace}
@media screen and (prefers-color-scheme:dark){:root{--page:#16181a;--text:#e6e3dc;--soft:#a5a29a;--rule:#8b8982;--faint:#33363a;
--good:#4fc9a0;--bad:#f2905f}}
sub,sup{font-size:.72em;line-height:0}
.lead{color:var(--soft);margin:0 0 1rem}
.model{display:grid;grid-template-columns:max-content minmax(0,1fr);gap:.15rem 1rem;margin:0 0 1rem;font-size:.9rem}
.model dt{color:var(--soft)}
.model dd{margin:0;overflow-wrap:anywhere;min-width:0}
.model .displayed{margin-left:0;padding:.1rem 0 .1rem 1.6rem}
math{font-size:1.05em}
.displayed math{margin-block:.14em}
.displayed{margin:0 0 0 2rem;padding:.32rem 0 .32rem 1.6rem;text-indent:-1.6rem;overflow-x:auto;overflow-y:hidden}
.brackets td,.brackets th{padding:.22rem 1rem .22rem 0;text-align:center}
figure{margin:1.2rem 0 2.2rem}
figcaption{color:var(--soft);font-size:.9rem;margin-top:.4rem;max-width:42rem}
figcaption b{color:var(--text);font-weight:normal;font-variant:small-caps}
.panels{display:grid;grid-template-columns:minmax(0,1fr);gap:.8rem;overflow-x:auto;padding-left:1rem;margin-left:-1rem}
.panels.abreast{grid-template-columns:repeat(auto-fill,minmax(19rem,1fr))}
svg{display:block;max-width:100%;height:auto;overflow:visible}
.ladder text{font-size:18px}
.ladder .dimension{font-size:13px;fill:var(--soft)}
.ladder .map{font-size:15px;fill:var(--soft)}
.arrow{stroke:var(--rule)}
svg .heading{font-style:italic}
.legend{list-style:none;display:flex;flex-wrap:wrap;gap:.1rem 1.4rem;margin:.2rem 0 .5rem;padding:0;font-size:.88rem}
.legend li{display:flex;align-items:center;gap:.5rem}
.scroll{overflow-x:auto;margin:1rem 0}
table{border-collapse:collapse;font-size:.85rem;line-height:1.35;border-top:1.5px solid var(--text);border-bottom:1.5px solid var(--text)}
caption{text-align:left;color:var(--soft);padding-bottom:.35rem;white-space:nowrap}
th,td{padding:.22rem .75rem .22rem 0;text-align:left;font-weight:normal;vertical-align:baseline;min-width:3.2rem}
tbody th+td:not(.number){min-width:8rem}
thead th{border-bottom:1px solid var(--rule);color:var(--soft);vertical-align:bottom}
td.number{font-variant-numeric:tabular-nums lining-nums;white-space:nowrap}
.good{color:var(--good);white-space:nowrap}
.bad{color:var(--bad);font-weight:bold;white-space:nowrap}
.message{border-left:3px solid var(--bad);padding-left:.8rem}
details{margin:.5rem 0}
summary{cursor:pointer}
@media (max-width:44rem){.panels:not(.abreast) svg{min-width:34rem;max-width:none}.diagram svg{max-width:none}}
.scripted .panels{overflow:visible}
.chart{position:relative;touch-action:pan-y;outline-offset:4px;border-radius:3px;user-select:none;-webkit-user-select:none}
.chart:focus{outline:none}
.chart:focus-visible{outline:2px solid var(--c0)}
.chart>svg{min-width:0!important;max-width:100%!important;cursor:crosshair}
.series path{vector-effect:non-scaling-stroke}
.cross,.now,.selection{pointer-events:none}
.cross line{stroke:var(--soft);stroke-width:.8;stroke-dasharray:3 3}
.now line{stroke:var(--bad);stroke-width:1}
.now .spoke{stroke:var(--ink);stroke-width:1.6}
.now .bar{stroke:var(--text);stroke-width:3;stroke-linecap:round;opacity:.8}
.panel:has(.now circle) .endpoints{opacity:.35}
.dot{fill:var(--ink);stroke:var(--page);stroke-width:1.5}
.selection{fill:var(--c0);fill-opacity:.15;stroke:var(--c0);stroke-width:.8}
.readout{position:absolute;z-index:2;pointer-events:none;background:var(--page);border:1px solid var(--rule);border-radius:3px;padding:.25rem .5rem;
box-shadow:0 1px 5px rgb(0 0 0/.18);font-size:.82rem;max-width:100%}
.readout table{border:0;font-size:inherit}
.readout th,.readout td{padding:.02rem .5rem .02rem 0;min-width:0;white-space:nowrap}
.readout td{text-align:right;padding-right:0;font-variant-numeric:tabular-nums lining-nums}
.readout tr:has(.strong){color:var(--soft)}
.swatch{display:inline-block;width:.9em;height:3px;background:var(--ink);vertical-align:middle;margin-right:.45em}
.swatch.none{display:none}
.rest{fill:var(--ink);stroke:none}
.note{margin:.1rem 4.2rem .3rem 0;min-height:1.7rem;color:var(--soft);font-size:.82rem;line-height:1.3}
.whole{position:absolute;z-index:1;right:0;bottom:.3rem}
.instant{position:sticky;top:0;z-index:3;display:flex;align-items:center;gap:.8rem;margin:0 -1.2rem;padding:.5rem 1.2rem;background:var(--page);
border-bottom:1px solid var(--faint)}
.instant input{flex:1;min-width:0;height:1.8rem;accent-color:var(--c0)}
.instant .time{min-width:7.5rem;font-variant-numeric:tabular-nums lining-nums;white-space:nowrap}
.instant .play{min-width:2.4rem;min-height:2rem}
@media print{.instant,.readout,.whole,.note,.now,.cross{display:none}:root{--page:#fff}figure,table{break-inside:avoid}
.panels.abreast{grid-template-columns:1fr 1fr}.scroll,.panels{overflow:visible}table{font-size:7.5pt}})css";

// The frame of a page that is read from top to bottom.
constexpr std::string_view style_of_frame = R"css(
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--text);font:17px/1.5 var(--serif)}
main{max-width:48rem;margin:0 auto;padding:2.2rem 1.2rem 4rem}
h1{font-size:1.75rem;line-height:1.2;font-weight:normal;margin:0 0 .3rem}
h2{font-size:1.2rem;font-weight:normal;font-variant:small-caps;letter-spacing:.03em;margin:2.6rem 0 .6rem;
border-bottom:1px solid var(--faint)}
h1,p,figcaption,li,summary{overflow-wrap:anywhere}
pre{font:13px/1.45 var(--mono);overflow-x:auto;background:color-mix(in srgb,var(--faint) 40%,transparent);padding:.8rem 1rem}
footer{margin-top:3rem;color:var(--soft);font-size:.85rem}
button{font:inherit;font-size:.82rem;color:var(--text);background:var(--page);border:1px solid var(--rule);border-radius:3px;padding:.1rem .5rem;cursor:pointer}
@media print{body{font-size:10.5pt}main{max-width:none;padding:0}h2{break-after:avoid}}
)css";

}  // namespace

std::string content_style() { return std::string(style_of_content) + plot::figure_style(); }

Markup page_section(std::string_view title, const Markup& content) {
  if (content.str().empty()) return {};
  return element("section", {}, element("h2", {}, title) + content);
}

std::string whole_page(std::string_view title, const Markup& body, const Markup& script) {
  const Markup head =
      element("meta", {{"charset", "utf-8"}}) +
      element("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}) +
      element("title", {}, title) +
      plot::style_sheet(content_style() + std::string(style_of_frame));
  const Markup page =
      element("html", {{"lang", "en"}, {"xmlns", "http://www.w3.org/1999/xhtml"}},
              element("head", {}, head) + element("body", {}, element("main", {}, body) + script));
  return "<!DOCTYPE html>\n" + page.str() + "\n";
}

}  // namespace courant
