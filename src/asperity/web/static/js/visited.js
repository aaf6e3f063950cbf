/** What was open last, kept by the browser: each screen with its case, the latest first. */
import { caseParams } from "./state.js";

const KEY = "asperity-visited";
const MOST = 6;

/** @returns {{title: string, says: string, hash: string}[]} */
export function lastOpened() {
  try {
    const known = JSON.parse(localStorage.getItem(KEY) ?? "[]");
    return known.filter((each) => typeof each?.hash === "string" && each.hash.startsWith("#/")
      && typeof each.title === "string" && typeof each.says === "string");
  } catch {
    return [];
  }
}

/** Note that a screen is open. @param {string} title @param {string} hash @param {Record<string, string>} params */
export function visited(title, hash, params) {
  const changes = Object.keys(caseParams(params)).length - 1;
  const says = [params.case, changes > 0 ? `${changes} set` : ""].filter(Boolean).join(", ");
  const same = (each) => each.title === title && each.says.split(",")[0] === (params.case ?? "");
  const others = lastOpened().filter((each) => !same(each));
  localStorage.setItem(KEY, JSON.stringify([{ title, says, hash }, ...others].slice(0, MOST)));
}
