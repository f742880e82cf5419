// Reads a URDF into what urdf-loader can take: a forest without faults. While a robot is being
// written, joints lead nowhere, mimic nobody or close loops; all that can be shown still is.

/** Return the child elements of a name. */
export const childrenOf = (element, name) =>
  [...element.children].filter((child) => child.nodeName === name);

/** Return the first child element of a name, or undefined. */
export const childOf = (element, name) =>
  [...element.children].find((child) => child.nodeName === name);

/** Return the numbers in an attribute, or a default if these are not as many. */
export function numbersIn(element, attribute, fallback) {
  const text = element?.getAttribute(attribute)?.trim();
  if (!text) return fallback;
  const numbers = text.split(/\s+/).map(Number);
  return numbers.length === fallback.length && numbers.every(Number.isFinite) ? numbers : fallback;
}

/**
 * Parse a URDF and take out the joints that cannot be shown.
 * @returns {{robot: Element, roots: string[], dropped: string[]}}
 */
export function readUrdf(text) {
  const robot = new DOMParser().parseFromString(text, "text/xml").documentElement;
  const links = new Set(childrenOf(robot, "link").map((link) => link.getAttribute("name")));
  const dropped = [];
  const parentOf = new Map();
  const seen = new Set();
  for (const joint of childrenOf(robot, "joint")) {
    const name = joint.getAttribute("name");
    const [parent, child] = ["parent", "child"].map((end) =>
      childOf(joint, end)?.getAttribute("link"),
    );
    const isSound =
      links.has(parent) && links.has(child) && !parentOf.has(child) && !seen.has(name);
    if (!isSound || leadsTo(parent, child, parentOf)) {
      joint.remove();
      dropped.push(name ?? "");
      continue;
    }
    seen.add(name);
    parentOf.set(child, parent);
    tidyJoint(joint);
  }
  dropBadMimics(robot);
  return { robot, roots: [...links].filter((link) => !parentOf.has(link)), dropped };
}

// Names that urdf-loader cannot take: the one that an object cannot have a value under, and those that
// end a selector. What stands in for them is in no XML.
const CANNOT_BE_TAKEN = /^__proto__$|["\\\n\r\f]/;
const STAND_IN = "\u0001";
const standIns = new Map(); // name → what stands in for it
const namesOf = new Map(); // the other way

function standInOf(name) {
  if (!standIns.has(name)) {
    standIns.set(name, `${STAND_IN}${standIns.size}`);
    namesOf.set(standIns.get(name), name);
  }
  return standIns.get(name);
}

const nameOf = (name) => namesOf.get(name) ?? name;

/** Return what urdf-loader makes of a robot; it keeps links and joints in objects by their names. */
export function parseWith(loader, robot) {
  const changed = [];
  for (const element of robot.querySelectorAll("*")) {
    for (const { name, value } of [...element.attributes]) {
      if (!CANNOT_BE_TAKEN.test(value)) continue;
      element.setAttribute(name, standInOf(value));
      changed.push([element, name, value]);
    }
  }
  const object = loader.parse(robot);
  for (const [element, name, value] of changed) element.setAttribute(name, value);
  object.traverse((one) => {
    if (!namesOf.has(one.name)) return;
    one.name = one.urdfName = nameOf(one.name);
  });
  return object;
}

/** Return the links or joints of urdf-loader by their names, whatever these are. */
export const byName = (found) =>
  new Map(Object.entries(found).map(([name, one]) => [nameOf(name), one]));

/** Tell whether a link is another one or lies below it. */
function leadsTo(link, ancestor, parentOf) {
  for (let step = link; step !== undefined; step = parentOf.get(step)) {
    if (step === ancestor) return true;
  }
  return false;
}

/** Write an axis as urdf-loader reads it. */
function tidyJoint(joint) {
  const axis = childOf(joint, "axis");
  if (!axis) return;
  const direction = numbersIn(axis, "xyz", [1, 0, 0]);
  const isNone = direction.every((entry) => entry === 0);
  axis.setAttribute("xyz", (isNone ? [1, 0, 0] : direction).join(" "));
}

/** Take out mimics of joints that are not there, and of those that mimic each other in a ring. */
function dropBadMimics(robot) {
  const mimics = new Map();
  const joints = new Set(childrenOf(robot, "joint").map((joint) => joint.getAttribute("name")));
  for (const joint of childrenOf(robot, "joint")) {
    const mimic = childOf(joint, "mimic");
    if (!mimic) continue;
    const name = joint.getAttribute("name");
    const model = mimic.getAttribute("joint");
    if (!joints.has(model) || leadsTo(model, name, mimics)) mimic.remove();
    else mimics.set(name, model);
  }
}
