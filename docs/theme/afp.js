// Colours for plans and toolboxes in the rendered book. A test keeps the words those of the grammar.
(() => {
  const words =
    "active actor afp after always and as at before budget by commit computation const deadline device end " +
    "enum event every exclusive expect fail false fault for forever from heading icon ignore in interrupt live needs never object " +
    "of on once out over plan press resumable resume return robot running scenario seed seeds sensor set signal start state states stop subplan " +
    "supervise supervisor suspend suspended table terminate times to toolbox true truth until use uses var version when within " +
    "world worlds";
  const unit = "([kcmun]?m|m?rad|deg|[mun]?s|min|h|k?g|[mk]?N|m?V|K|degC|[kM]?Hz)";
  hljs.registerLanguage("afp", () => ({
    keywords: words,
    contains: [
      { className: "comment", begin: "//", end: "$" },
      { className: "string", begin: '"', end: '"', contains: [{ begin: "\\\\." }] },
      { className: "number", begin: `\\b\\d+(\\.\\d+)?([eE][+-]?\\d+)?( ?${unit}([*/]${unit}(\\^\\d)?)*\\b)?` },
      // Ports and entries may be called like words of the language.
      { begin: "\\w+(?=\\s*(:|=|->))" },
    ],
  }));
  document.querySelectorAll("code.language-afp").forEach((code) => hljs.highlightBlock(code));
})();
