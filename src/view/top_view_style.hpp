// Colours of the top view for light pages, and what changes on dark ones.
#pragma once

namespace mamo::view {

/// Explicit colours per class: renderers that know no CSS variables and no media queries show the light page.
inline constexpr const char* kTopViewStyle = R"css(
text{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;fill:#1f2933}
.bg{fill:#ffffff}
.title{font-size:18px;font-weight:600}
.sub{font-size:12px;fill:#5f6b76}
.key{font-size:12px}
.label{font-size:11px;paint-order:stroke;stroke:#ffffff;stroke-width:3px;stroke-linejoin:round;stroke-opacity:.85}
.place{font-size:10px;font-style:italic;fill:#7b8794;paint-order:stroke;stroke:#ffffff;stroke-width:3px}
.leader{stroke:#7b8794;stroke-width:.8;fill:none}
.grid{stroke:#eceff2;stroke-width:1;fill:none}
.fixture{fill:#eef0f3;stroke:#b4bcc5;stroke-width:1.2}
.roof{fill:none;stroke:#b4bcc5;stroke-width:1;stroke-dasharray:2 4}
.body{fill:#8d99a6;fill-opacity:.15;stroke:#8d99a6;stroke-width:.8;stroke-opacity:.6}
.arm0{fill:#52606d;fill-opacity:.14;stroke:#52606d;stroke-width:.9;stroke-opacity:.55}
.arm1{fill:#7048e8;fill-opacity:.13;stroke:#7048e8;stroke-width:1;stroke-opacity:.65}
.immovable{fill:#f1b5b5;stroke:#b42318;stroke-width:1.4}
.movable{fill:#b9d6fb;stroke:#2f6fc4;stroke-width:1.2}
.moved{fill:#ffd9a0;stroke:#c46a0a;stroke-width:1.4}
.was{fill:none;stroke:#c46a0a;stroke-width:1.1;stroke-dasharray:4 3}
.arrow{fill:none;stroke:#8a4b06;stroke-width:1.6}
.head{fill:#8a4b06;stroke:none}
.target{fill:#b7e4c0;stroke:#237a3b;stroke-width:2}
.goal{fill:none;stroke:#237a3b;stroke-width:2;stroke-linecap:round}
.halo{fill:none;stroke:#ffffff;stroke-width:5;stroke-opacity:.75;stroke-linejoin:round;stroke-linecap:round}
.tip{fill:none;stroke-width:2.2;stroke-linejoin:round;stroke-linecap:round}
.approach{stroke:#1c7ed6}
.push{stroke:#e8590c}
.retreat{stroke:#868e96}
.reach{stroke:#7048e8}
.grasp{stroke:#d6336c}
.extract{stroke:#2b8a3e}
.dot{fill:#ffffff;stroke:#1f2933;stroke-width:1.6}
.bar{fill:none;stroke:#1f2933;stroke-width:1.6}
@media (prefers-color-scheme: dark){
text{fill:#e4e7eb}
.bg{fill:#14181d}
.sub{fill:#9aa5b1}
.label{stroke:#14181d}
.place{fill:#8793a0;stroke:#14181d}
.grid{stroke:#20262d}
.fixture{fill:#232a32;stroke:#55616d}
.roof{stroke:#55616d}
.arm0{fill:#b8c2cc;stroke:#b8c2cc}
.arm1{fill:#9775fa;stroke:#9775fa}
.immovable{fill:#6b2b2b;stroke:#f08c8c}
.movable{fill:#234a7d;stroke:#7fb3f5}
.moved{fill:#7a4a12;stroke:#ffb454}
.was{stroke:#ffb454}
.arrow{stroke:#ffd9a0}
.head{fill:#ffd9a0}
.target{fill:#1f5c30;stroke:#69db7c}
.goal{stroke:#69db7c}
.halo{stroke:#14181d}
.approach{stroke:#4dabf7}
.push{stroke:#ff922b}
.retreat{stroke:#adb5bd}
.reach{stroke:#9775fa}
.grasp{stroke:#f06595}
.extract{stroke:#51cf66}
.dot{fill:#14181d;stroke:#e4e7eb}
.bar{stroke:#e4e7eb}
}
)css";

}  // namespace mamo::view
