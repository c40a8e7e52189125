use afp_sim::World;
use afp_sim::world::Mobility;

#[test]
fn a_hundred_rooms_are_furnished_and_differ() {
    let mut texts = Vec::new();
    let (mut pieces, mut pushed, mut walkers, mut low, mut divided) = (0, 0, 0, 0, 0);
    for seed in 0..100 {
        let world = World::random(seed);
        let text = World::random_text(seed);
        assert_eq!(World::parse(&text).as_ref(), Ok(&world), "seed {seed}");
        assert!(world.obstacles.len() > 4, "seed {seed} has walls and furniture");
        let count = |is: fn(&Mobility) -> bool| {
            world.obstacles.iter().filter(|obstacle| is(&obstacle.mobility)).count()
        };
        pieces += world.obstacles.len() - 4;
        pushed += count(|mobility| matches!(mobility, Mobility::Movable { .. }));
        walkers += count(|mobility| matches!(mobility, Mobility::Scripted(_)));
        low += world.obstacles.iter().filter(|obstacle| obstacle.height < 0.15).count();
        divided += usize::from(text.contains("partition"));
        texts.push(text);
    }
    assert!(pieces > 400, "{pieces} pieces");
    assert!(
        pushed > 20 && walkers > 10 && low > 20 && divided > 20,
        "{pushed} {walkers} {low} {divided}"
    );
    texts.sort();
    texts.dedup();
    assert_eq!(texts.len(), 100);
}
