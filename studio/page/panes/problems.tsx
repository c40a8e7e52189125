// Problems: a click selects the place, a button applies a fix.
import { useEffect } from "preact/hooks";
import { Code } from "../screen/book";
import { Severity } from "../screen/icons";
import { current } from "../documents/documents";
import { askFixes, fixes, mend, problems, said, severityOf, type Diagnostic } from "../plan/problems";
import { reveal } from "../plan/places";
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
