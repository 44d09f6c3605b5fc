// The policy of coach_policy.py in JavaScript, without a helper library: the protocol is one line of JSON in each
// direction (docs/outside-methods.md).
import readline from "node:readline";

const PROTOCOL = 1;
const ENOUGH = 2;
const REST = 3;

function say(message) {
  process.stdout.write(JSON.stringify(message) + "\n");
}

let wrong = new Map();
let rest = 0;

function step(shown) {
  let correct = false;
  for (const { move, verdict } of shown.verdicts) {
    rest = Math.max(0, rest - 1);
    const row = verdict === "wrong" ? (wrong.get(move) ?? 0) + 1 : 0;
    wrong.set(move, row);
    if (row >= ENOUGH && rest === 0) {
      correct = true;
      rest = REST;
      wrong = new Map();
    }
  }
  return { correct };
}

for await (const line of readline.createInterface({ input: process.stdin })) {
  const message = JSON.parse(line);
  if (message.type === "hello") {
    if (message.protocol !== PROTOCOL) {
      console.error(`speaks protocol ${PROTOCOL}, was asked for ${message.protocol}`);
      process.exit(1);
    }
    say({ type: "hello", protocol: PROTOCOL, name: "coach-policy-javascript", version: "1.0" });
  } else if (message.type === "setting") {
    say({ type: "ready" });
  } else if (message.type === "begin") {
    wrong = new Map();
    rest = 0;
    say({ type: "ready" });
  } else if (message.type === "step") {
    say({ type: "answer", id: message.id, number: message.number, answer: step(message.step) });
  }
}
