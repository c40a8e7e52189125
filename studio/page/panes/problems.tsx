// What is wrong: a click selects it, a fix is made by a click.
import { useEffect } from "preact/hooks";
import { Code } from "../book";
import { Severity } from "../icons";
import { current } from "../documents";
import { askFixes, fixes, mend, problems, said, severityOf, type Diagnostic } from "../problems";
import { reveal } from "../places";
import { words } from "../words";

export function Problems() {
  useEffect(askFixes, []);
  if (problems.value.length === 0) return <p class="empty">{words.noProblems}</p>;
  return (
    <ul class="problems">
      {problems.value.map((each, at) => (
        <Problem of={each} key={`${at} ${each.code} ${each.message}`} />
      ))}
    </ul>
  );
}

function Problem({ of }: { of: Diagnostic }) {
  const severity = severityOf(of);
  const { message, help } = said(of);
  const { line, character } = of.range.start;
  return (
    <li>
      <button class="row" onClick={() => reveal(current.value, of.range, "other")}>
        <Severity of={severity} />
        <span class="said">
          <span class="hidden">{words.severity[severity]}: </span>
          {message}
          {help && <span class="help">{help}</span>}
        </span>
        <span class="place">{`${line + 1}:${character + 1}`}</span>
      </button>
      {of.code && <Code of={of.code} />}
      {fixes.value.get(of)?.map((fix) => (
        <button class="fix" onClick={() => void mend(fix)} key={fix.title}>{words.fix(fix.title)}</button>
      ))}
    </li>
  );
}
