// The column beside the scene: what the colours mean, layers, contacts, facts.
"use strict";

const kRoles = [
  ["target", "object of interest"], ["moved", "moved by the plan"], ["relevant", "relevant, not moved"],
  ["movable", "movable"], ["immovable", "immovable"], ["fixture", "fixture"],
];

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

class Panel {
  constructor(root, data, player) {
    this.root = root;
    this.data = data;
    this.player = player;
    const {outcome} = data;
    if (outcome.reason || outcome.findings.length) this.add(outcome.kind === "failed" ? "Why it failed" : "Outcome", this.outcome());
    this.add("Objects", this.legend());
    this.add("Layers", this.layers());
    if (player.replay.contacts.length) this.add("Contacts", this.contacts());
    this.add("Facts", this.facts());
    this.add("Keys", this.keys());
  }

  add(title, content) {
    this.root.append(element("section", {}, element("h2", {}, title), content));
  }

  outcome() {
    const {outcome} = this.data;
    const list = element("div", {class: "outcome"});
    if (!outcome.findings.length) list.append(element("p", {}, outcome.reason));
    for (const finding of outcome.findings)
      list.append(element("p", {}, finding.text, " ",
                          element("button", {class: "link", onclick: () => this.player.seek(finding.t)}, "go there")));
    return list;
  }

  legend() {
    const list = element("ul", {class: "legend"});
    for (const [role, text] of kRoles) {
      const objects = this.data.objects.filter((object) => object.role === role);
      if (!objects.length) continue;
      const names = objects.map((object) => object.id).join(", ");
      list.append(element("li", {title: names}, element("i", {style: `background:var(--${role})`}), text + " ",
                          element("span", {class: "soft"}, role === "fixture" ? String(objects.length) : names)));
    }
    if (this.data.objects.some((object) => object.relevant))
      list.append(element("li", {}, element("i", {class: "hollow"}), "outlined: became relevant while planning"));
    return list;
  }

  layers() {
    const list = element("div", {class: "layers"});
    const row = (name, about, colour, checked, change) => {
      const box = element("input", {type: "checkbox", onchange: () => change(box.checked)});
      box.checked = checked;
      list.append(element("label", {title: about}, box, element("i", {style: `background:var(--${colour})`}), name));
      return box;
    };
    for (const layer of this.player.layers.layers) {
      layer.box = row(layer.name, layer.about, layer.colour, layer.group.visible, (on) => {
        this.player.layers.toggle(layer, on);
        details.hidden = !on;
      });
      const details = this.layerDetails(layer);
      details.hidden = !layer.group.visible;
      list.append(details);
    }
    const {bodies, contacts} = this.player;
    if (bodies.hasVisuals) row("collision shapes of the robot", "what the planner collides with", "arm", false, (on) => bodies.showCollision(on));
    row("robot", "the whole robot", "body", true, (on) => { bodies.links[0].visible = on; this.player.redraw(); });
    if (bodies.goal) row("goal of the tip", "where the tip shall go", "goal", true, (on) => { bodies.goal.visible = on; this.player.redraw(); });
    if (this.player.replay.contacts.length) row("contacts", "flashes where bodies touch", "contact", true, (on) => { contacts.group.visible = on; this.player.redraw(); });
    return list;
  }

  /** What a layer says, its items in order, by planning iteration where they have one. */
  layerDetails(layer) {
    const details = element("div", {class: "details soft"}, layer.about);
    const told = layer.items.filter((item) => item.text && !["tip path", "motion of objects"].includes(layer.name));
    let list = null, iteration;
    for (const item of told.slice(0, 200)) {
      if (!list || item.iteration !== iteration) {
        iteration = item.iteration;
        if (iteration !== undefined) details.append(element("div", {class: "iteration"}, `iteration ${iteration}`));
        list = element("ul");
        details.append(list);
      }
      list.append(element("li", {}, item.text));
    }
    if (told.length > 200) details.append(`and ${told.length - 200} more`);
    return details;
  }

  contacts() {
    const list = element("ul", {class: "contacts"});
    for (const contact of this.player.replay.contacts.slice(0, 60))
      list.append(element("li", {}, element("button", {class: "link", onclick: () => this.player.seek(contact.from)},
                                           contact.from.toFixed(2) + " s"),
                          ` ${nameOf(this.data, contact.a)} – ${nameOf(this.data, contact.b)} `,
                          element("span", {class: "soft"}, `${(contact.to - contact.from).toFixed(2)} s`)));
    const more = this.player.replay.contacts.length - 60;
    if (more > 0) list.append(element("li", {class: "soft"}, `and ${more} more`));
    return list;
  }

  facts() {
    const table = element("table", {class: "facts"});
    for (const [name, value] of this.data.facts)
      table.append(element("tr", {}, element("td", {class: "soft"}, name), element("td", {}, value)));
    return table;
  }

  keys() {
    const list = element("div", {class: "keys soft"});
    for (const [key, text] of [["space", "play or pause"], ["← →", "0.1 s back or on, with shift 1 s"],
                               ["[ ]", "segment before or after"], ["− +", "slower or faster"], ["Home End", "start or end"],
                               ["1 … 9", "switch a layer"], ["r", "the first view again"], ["t", "light or dark"],
                               ["p", "this column"]])
      list.append(element("div", {}, element("kbd", {}, key), " ", text));
    list.append(element("div", {}, "Drag turns, shift-drag or two fingers move, wheel or pinch zooms."));
    return list;
  }
}
