// The text of the plan.
export const TextPane = () => <p class="empty" />;
