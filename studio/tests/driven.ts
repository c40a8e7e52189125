// A robot that drives: the real driver on a pseudo-terminal, with a stand-in for its controller.
import assert from "node:assert/strict";
import { execFile, spawn, type ChildProcess } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { promisify } from "node:util";
import { settled } from "./settled";

/** A plan that drives, counts and rests. */
export const DRIVE = [
  "use std",
  "use carbot",
  "",
  "plan Drive {",
  "    var rounds: int = 0",
  "",
  "    start ahead",
  "",
  "    actor ahead: Forward(distance = 15 cm) { ForwardSuccessful -> count }",
  "    computation count: Count(value = rounds, limit = 1000, next => rounds) {",
  "        Again -> rest",
  "        Done  -> terminate",
  "    }",
  "    actor rest: Wait(duration = 300 ms) { Elapsed -> ahead }",
  "}",
  "",
].join("\n");

const AFPC = process.env.AFPC ?? "";
/** The stand-in for the controller; 'cargo xtask test' builds it. */
const CONTROLLER = join(dirname(AFPC), "examples/controller");

/** A robot that runs the plan of its own folder. */
export class Robot {
  /** The lines of its controller: the port, then when the wheels turn and stop. */
  lines: string[] = [];
  /** The path of its socket. */
  socket = "";
  private said = "";
  private children: ChildProcess[] = [];
  private run!: ChildProcess;
  private folder = "";

  async begin(): Promise<void> {
    this.folder = await mkdtemp(join(tmpdir(), "afp-robot-"));
    await promisify(execFile)(AFPC, ["new", "mycar", "--profile", "carbot"], { cwd: this.folder });
    await writeFile(join(this.folder, "mycar/plans/drive.afp"), DRIVE);
    const controller = spawn(CONTROLLER, { stdio: ["ignore", "pipe", "inherit"] });
    this.children.push(controller);
    let said = "";
    controller.stdout.on("data", (bytes) => {
      said += String(bytes);
      this.lines = said.split("\n").slice(0, -1);
    });
    const port = await settled(async () => this.lines[0] ?? "", (line) => line !== "");
    // A busy machine must not count as a fault.
    const settings = ["--set", `robot.port=${port}`, "--set", "robot.realtime.stall=10s"];
    this.run = spawn(AFPC, ["run", "plans/drive.afp", "--robot", "hardware", "--log", "none", "--svg", "none", ...settings], {
      cwd: join(this.folder, "mycar"),
      stdio: ["ignore", "ignore", "pipe"],
      env: { ...process.env, XDG_RUNTIME_DIR: this.folder },
    });
    this.children.push(this.run);
    this.run.stderr!.on("data", (bytes) => (this.said += String(bytes)));
    const line = await settled(async () => this.said, (now) => /afpc attach \S+\n/.test(now));
    this.socket = /afpc attach (\S+)\n/.exec(line)?.[1] ?? assert.fail(line);
  }

  /** Waits until the wheels turn or stop. */
  async wheels(wanted: "turn" | "stop"): Promise<void> {
    const line = `the wheels ${wanted}`;
    assert.equal(await settled(async () => this.lines.at(-1) ?? "", (now) => now === line), line);
  }

  /** Waits until the plan has ended, and returns the exit code. */
  async ends(): Promise<number | null> {
    if (this.run.exitCode === null) await new Promise((done) => this.run.once("exit", done));
    return this.run.exitCode;
  }

  async end(): Promise<void> {
    this.children.forEach((child) => child.kill("SIGKILL"));
    await rm(this.folder, { recursive: true, force: true });
  }
}
