// The types of the page's data, as TypeScript, from the structs of page_data.hpp.
// usage: node types.mjs PAGE_DATA.hpp >data.ts     exit: 1 when a struct is none that it knows
import { readFileSync } from "node:fs";

const kArrays = { "std::uint8_t": "Uint8Array<ArrayBuffer>", "std::int16_t": "Int16Array",
  "std::uint16_t": "Uint16Array", "std::uint32_t": "Uint32Array", float: "Float32Array",
  double: "Float64Array" };
const kPlain = { "std::string": "string", bool: "boolean", int: "number", double: "number",
  "std::size_t": "number", "std::uint64_t": "number", SceneJson: "SceneData", FigureJson: "Figure",
  Vec3d: "[number, number, number]", Points: "Float32Array", Numbers: "Uint32Array" };
const text = readFileSync(process.argv[2], "utf8");
const structs = [...text.matchAll(
  /^struct (\w+) \{\n([^]*?)^\};\nGNBV_PAGE_FIELDS\((\w+),([^)]*)\)/gm)];

function typeOf(cpp) {
  const [, outer, inner, count] = cpp.match(/^([\w:]+)<(.*?)(?:, (\d+))?>$/) ?? [];
  if (outer === "Array" && kArrays[inner]) return kArrays[inner];
  if (outer === "std::optional") return `${typeOf(inner + (count ? `, ${count}` : ""))} | null`;
  if (outer === "std::vector") return `(${typeOf(inner)})[]`;
  if (outer === "std::array") return `[${Array(Number(count)).fill(typeOf(inner)).join(", ")}]`;
  if (kPlain[cpp] || structs.some(([, name]) => name === cpp)) return kPlain[cpp] ?? cpp;
  throw new Error(`${process.argv[2]}: no type of the page: ${cpp}`);
}

console.log("// Made of page_data.hpp by types.mjs.\nimport type { SceneData } from './colours';\n"
  + "import type { Figure } from './plots';");
for (const [, name, body, named, list] of structs) {
  const fields = [...body.matchAll(/^  ([\w:<>, ]+?) (\w+)(?:\s*=[^;]*|\{\})?;/gm)];
  const names = list.split(",").map((field) => field.trim());
  if (named !== name || names.join() !== fields.map(([, , field]) => field).join()) {
    throw new Error(`${process.argv[2]}: ${name}: GNBV_PAGE_FIELDS names other fields: ${names}`);
  }
  console.log(`\nexport interface ${name} {`);
  for (const [, type, field] of fields) console.log(`  ${field}: ${typeOf(type)};`);
  console.log("}");
}
